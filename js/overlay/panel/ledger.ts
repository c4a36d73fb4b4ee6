/**
 * What came of the presses: the ledger's numbers, and how often what was probable was pressed.
 *
 * @module
 */
import type { LedgerSummary, Outcome, Watcher } from "#dom";
import { draw, duration, make, percent, write } from "../elements.js";
import type { Part } from "./now.js";

/** The plot's place in its picture. */
const [LEFT, TOP, SIDE] = [24, 10, 116];

export function ledger(): Part {
  const count = make("span", {});
  const empty = make("p", {}, "No press on a target yet.");
  const figures = ["Right", "Wrong", "Lead", "Calibration"].map((name) => {
    const value = make("dd", {});
    return { value, item: make("div", {}, make("dt", {}, name), value) };
  });
  const numbers = make("dl", {}, ...figures.map(({ item }) => item));
  const points = draw("g", { fill: "var(--light)", "fill-opacity": 0.85, stroke: "var(--ground)", "stroke-width": 1 });
  const chart = plot(points);
  const filled = make("div", {}, numbers);
  filled.append(chart);
  const element = make("details", {}, make("summary", {}, "Ledger", count), make("div", { className: "inside" }, empty, filled));
  let shown: readonly [Watcher, Outcome | undefined, boolean] | null = null;
  return {
    element,
    update({ watcher }) {
      const state = [watcher, watcher.ledger.outcomes.at(-1), element.open] as const;
      // the numbers are over a thousand presses: they are computed when there is another one
      if (state.every((each, i) => each === shown?.[i])) return;
      shown = state;
      const summary = watcher.ledger.summary();
      write(count, `${summary?.presses ?? 0} ${summary?.presses === 1 ? "press" : "presses"}`);
      empty.hidden = summary !== null;
      filled.hidden = summary === null;
      if (!summary || !element.open) return;
      const { right, wrong, lead, calibration } = summary;
      const texts = [percent(right), percent(wrong), duration(lead), calibration?.toFixed(3) ?? "–"];
      figures.forEach(({ value }, i) => write(value, texts[i] as string));
      points.replaceChildren(...circles(summary));
      chart.setAttribute("aria-label", describe(summary));
    },
  };
}

/** Predicted across, observed upwards; on the diagonal what is probable by 70% is pressed seven times in ten. */
function plot(points: SVGElement): SVGElement {
  const [right, bottom] = [LEFT + SIDE, TOP + SIDE];
  const text = (x: number, y: number, anchor: string, words: string) => draw("text", { x, y, "text-anchor": anchor }, words);
  return draw(
    "svg",
    { class: "plot", viewBox: "0 0 300 144", role: "img" },
    draw("path", { d: `M${LEFT} ${TOP}V${bottom}H${right}`, stroke: "var(--muted)", "stroke-width": 1 }),
    draw("path", {
      d: `M${LEFT} ${bottom}L${right} ${TOP}`,
      stroke: "var(--muted)",
      "stroke-width": 1,
      "stroke-dasharray": "3 3",
    }),
    points,
    text(LEFT - 5, TOP + 8, "end", "1"),
    text(LEFT - 5, bottom, "end", "0"),
    text(right, bottom + 14, "end", "1"),
    text(LEFT, bottom + 14, "start", "0"),
    text(LEFT + SIDE / 2, bottom + 14, "middle", "predicted"),
    text(right + 14, TOP + 14, "start", "On the line: as often"),
    text(right + 14, TOP + 29, "start", "pressed as predicted."),
    text(right + 14, TOP + 51, "start", "Area: frames."),
  );
}

function circles({ bins }: LedgerSummary): SVGElement[] {
  const most = Math.max(...bins.map(({ frames }) => frames));
  return bins.map(({ frames, probability, pressed }) =>
    draw("circle", {
      cx: (LEFT + SIDE * probability).toFixed(1),
      cy: (TOP + SIDE * (1 - pressed)).toFixed(1),
      r: (2.5 + 5 * Math.sqrt(frames / most)).toFixed(1),
    }),
  );
}

function describe({ bins }: LedgerSummary): string {
  const each = bins.map(({ probability, pressed }) => `predicted ${percent(probability)}, pressed ${percent(pressed)}`);
  return `Calibration: ${each.join("; ") || "nothing yet"}`;
}
