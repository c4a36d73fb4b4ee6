// `npm run evaluate -- --menus`: menus laid around made-up movements, of which it is known what is to stay open.
import assert from "node:assert/strict";
import { mkdtemp, readFile, rm, writeFile } from "node:fs/promises";
import { tmpdir } from "node:os";
import { join } from "node:path";
import { after, before, describe, it } from "node:test";
import { capture } from "../../scripts/run.mjs";
import { isInside } from "../../tools/evaluate/intents/tracks.mjs";
import { judge } from "../../tools/evaluate/menus/figures.mjs";
import { KINDS, sceneOf } from "../../tools/evaluate/menus/scenes.mjs";
import { simulated } from "../../tools/evaluate/menus/simulated.mjs";

const tracks = simulated().slice(0, 200);

describe("menus around movements", () => {
  const scenes = tracks.flatMap((track) => KINDS.map((kind) => sceneOf(track, kind)).filter(Boolean));
  const of = (kind) => scenes.filter((scene) => scene.kind === kind);

  it("are of all kinds, shapes and sides, and the same every time", () => {
    for (const kind of KINDS) assert.ok(of(kind).length > 60, `${kind}: ${of(kind).length}`);
    const sides = (kind) => [...new Set(of(kind).map(({ side }) => side))].sort();
    for (const kind of KINDS) assert.deepEqual(sides(kind), ["bottom", "left", "right", "top"]);
    assert.deepEqual([...new Set(of("panel").map(({ shape }) => shape))].sort(), ["aligned", "far", "tall"]);
    assert.deepEqual(sceneOf(tracks[0], "away"), sceneOf(tracks[0], "away"));
  });

  it("begin in the trigger, and lead into the panel, to a sibling, or to neither", () => {
    for (const { kind, samples, trigger, panel, siblings } of scenes) {
      const [first, last] = [samples[0], samples.at(-1)];
      assert.ok(isInside(first, trigger));
      assert.equal(isInside(last, panel), kind === "panel");
      assert.equal(
        samples.some((sample) => isInside(sample, panel)),
        kind === "panel",
      );
      if (kind !== "panel")
        assert.equal(
          siblings.some((box) => isInside(last, box)),
          kind === "sibling",
        );
    }
  });

  it("have a panel beside its trigger, on its side, and siblings that overlap neither", () => {
    const apart = (a, b) =>
      Math.abs(a[0] - b[0]) >= (a[2] + b[2]) / 2 - 1e-9 || Math.abs(a[1] - b[1]) >= (a[3] + b[3]) / 2 - 1e-9;
    for (const { side, trigger, panel, siblings } of scenes) {
      for (const box of siblings) assert.ok(apart(box, trigger) && apart(box, panel));
      const beside = {
        right: panel[0] - panel[2] / 2 - (trigger[0] + trigger[2] / 2),
        left: trigger[0] - trigger[2] / 2 - (panel[0] + panel[2] / 2),
        bottom: panel[1] - panel[3] / 2 - (trigger[1] + trigger[3] / 2),
        top: trigger[1] - trigger[3] / 2 - (panel[1] + panel[3] / 2),
      }[side];
      assert.ok(beside >= 1.99 && beside <= 120.01, `${side}: ${beside}`);
    }
  });

  it("are judged by when the panel was closed", () => {
    const trigger = [0, 0, 20, 20];
    const scene = {
      trigger,
      samples: [
        [0, 0, 0],
        [0.1, 30, 0],
        [0.3, 90, 0],
      ],
      arrival: 0.3,
    };
    const outcome = (time) => time && { time };
    const wrong = (kind, time) => judge({ ...scene, kind }, outcome(time)).wrong;
    assert.deepEqual([wrong("panel", null), wrong("panel", 0.2), wrong("panel", 0.4)], [false, true, false]);
    assert.deepEqual([wrong("away", null), wrong("away", 0.2), wrong("away", 0.4)], [true, false, true]);
    assert.ok(Math.abs(judge({ ...scene, kind: "sibling" }, outcome(0.25)).seconds - 0.15) < 1e-12);
    assert.ok(Math.abs(judge({ ...scene, kind: "sibling" }, null).seconds - 2.2) < 1e-12);
  });
});

describe("npm run evaluate -- --menus", () => {
  let folder, output, figures;
  before(async () => {
    folder = await mkdtemp(join(tmpdir(), "whither-menus-"));
    const file = join(folder, "made-up.jsonl");
    // both halves of the users
    const lines = tracks.slice(0, 40).map((track) => JSON.stringify(track));
    await writeFile(file, [...lines, "{}"].join("\n"));
    const report = join(folder, "report.json");
    const run = await capture("node", ["tools/evaluate/menus/menus.mjs", "--json", report, file]);
    assert.equal(run.code, 0, run.output);
    output = run.output;
    figures = JSON.parse(await readFile(report, "utf8")).menus;
  });
  after(() => rm(folder, { recursive: true }));

  /** The share of a kind that a method had wrong. */
  const wrong = (method, kind) => {
    const rows = figures.filter((row) => row.method === method && row.kind === kind);
    const sum = (of) => rows.reduce((total, row) => total + of(row), 0);
    return sum((row) => row.wrong * row.scenes) / sum((row) => row.scenes);
  };

  it("closes everything without a delay, and holds half of everything with one", () => {
    assert.equal(wrong("0 ms", "panel"), 1);
    assert.equal(wrong("0 ms", "sibling"), 0);
    assert.ok(wrong("300 ms", "sibling") > 0.2);
  });

  it("has the peer's own code at work: it closes up to two thirds on the way of a hand that makes detours, and holds none", () => {
    assert.ok(wrong("safePolygon", "panel") < 0.67);
    assert.ok(wrong("safePolygon", "away") < 0.05);
  });

  it("has whither/menu close at most 8% on the way, and hold at most a quarter of what goes elsewhere", (t) => {
    for (const method of ["heldOpen", "handleClose"]) {
      const shares = ["panel", "sibling", "away"].map((kind) => wrong(method, kind));
      t.diagnostic(`${method}: ${shares.map((share) => (100 * share).toFixed(1)).join(", ")}%`);
      const [panel, ...held] = shares;
      assert.ok(panel <= 0.08 && Math.max(...held) <= 0.25, shares.join());
    }
  });

  it("prints tables, and names a line that is no track", () => {
    assert.match(output, /made-up.jsonl:41: targets: must be a list/);
    assert.match(output, /^\| heldOpen +\|/m);
    assert.match(output, /All sets, wrongly closed %, by how the panel lies/);
  });
});
