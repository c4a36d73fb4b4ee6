// What was measured of menus, as tables and as figures.
import { table } from "../../../scripts/table.mjs";
import { milliseconds, percent } from "../intents/report.mjs";
import { Sums } from "./figures.mjs";

/** What the columns are. */
export const LEGEND = `Menus around the movements, as tools/evaluate/menus/scenes.mjs lays them, with the panel open at the start.
wrongly closed: of movements into the panel, those in which it was closed or switched before the pointer came to it. wrongly held: of movements to
a sibling of the trigger, and elsewhere, those in which it was still open when the pointer came there. switch, close: mean ms from the
trigger's edge until it was closed.
`;

const HEADINGS = ["", "wrongly closed %", "wrongly held, to a sibling %", "elsewhere %", "switch ms", "close ms"];

/** Prints the methods on a set. */
export function printSet(name, scored) {
  const of = (kind) => scored.filter(({ scene }) => scene.kind === kind);
  const scenes = (kind) => new Set(of(kind).map(({ scene }) => scene)).size;
  console.log(
    `${name}: ${scenes("panel")} movements into the panel, ${scenes("sibling")} to a sibling, ${scenes("away")} elsewhere\n`,
  );
  const rows = methodsOf(scored).map((method) => {
    const [panel, sibling, away] = ["panel", "sibling", "away"].map((kind) => sum(of(kind), method).figures());
    const share = (figures) => (figures ? percent(figures.wrong) : "-");
    const time = (figures) => (figures ? milliseconds(figures.seconds) : "-");
    return [method, share(panel), share(sibling), share(away), time(sibling), time(away)];
  });
  table(HEADINGS, rows);
}

/** Prints how often panels of each shape, and on each side, were wrongly closed, of all sets. */
export function printShapes(all) {
  const into = all.filter(({ scene }) => scene.kind === "panel");
  const groups = [
    ...["aligned", "far", "tall"].map((shape) => [shape, ({ scene }) => scene.shape === shape]),
    ...["right", "left", "bottom", "top"].map((side) => [`at the ${side}`, ({ scene }) => scene.side === side]),
  ];
  const [first] = methodsOf(into);
  const count = (is) => into.filter((each) => each.method === first && is(each)).length;
  console.log("All sets, wrongly closed %, by how the panel lies (movements)\n");
  table(
    ["", ...groups.map(([name, is]) => `${name} (${count(is)})`)],
    methodsOf(into).map((method) => [
      method,
      ...groups.map(([, is]) => percent(sum(into.filter(is), method).figures()?.wrong ?? null)),
    ]),
  );
}

/** All figures: by set, method, kind and shape. */
export function figuresOf(all) {
  const groups = new Map();
  for (const { set, method, scene, judged } of all) {
    const { kind, shape, side } = scene;
    const group = { set, method, kind, shape, side };
    const key = JSON.stringify(group);
    const sums = groups.get(key) ?? { group, sums: new Sums() };
    sums.sums.add(judged);
    groups.set(key, sums);
  }
  return Array.from(groups.values(), ({ group, sums }) => ({ ...group, ...sums.figures() }));
}

function methodsOf(scored) {
  return [...new Set(scored.map(({ method }) => method))];
}

function sum(scored, method) {
  const sums = new Sums();
  for (const each of scored) if (each.method === method) sums.add(each.judged);
  return sums;
}
