import assert from "node:assert/strict";
import { describe, it } from "node:test";
import type { Outcome } from "../ledger.js";
import type { Target } from "../targets.js";
import type { Press } from "./outcome.js";
import { Records } from "./records.js";

const [radio, seats] = ["radio", "seats"].map((id) => ({ node: { id }, settings: {} })) as never as readonly [Target, Target];

/** A press on a target that this lead and these most probable targets came before. */
function press(
  target: Target,
  lead: number,
  leaders: readonly (readonly [Target, number])[] = [],
  line: string | null = null,
): Press {
  const outcome = { id: target.node.id, verdict: lead > 0 ? "right" : "unsure", lead } as Outcome;
  return { target, outcome, leaders: leaders.map(([one, probability]) => ({ target: one, probability })), line };
}

function recorded(presses: readonly Press[]): Records {
  const records = new Records();
  for (const each of presses) records.add(each);
  return records;
}

describe("records", () => {
  it("have the shares, and the median of the leads, of an even number of presses too", () => {
    const three = [press(seats, 0.2), press(radio, 0.9), press(seats, 0)];
    assert.deepEqual(recorded(three).summary(), { presses: 3, right: 2 / 3, wrong: 0, lead: 0.2, calibration: null, bins: [] });
    assert.equal(recorded([...three, press(seats, 0.5)]).summary()?.lead, 0.35);
    assert.equal(recorded([]).summary(), null);
  });

  it("have the expected calibration error: by bins, weighted by how many frames are in each", () => {
    // .5 thrice, of which two are pressed; 1 once, which is not
    const { calibration, bins } = recorded([
      press(seats, 0, [
        [seats, 0.5],
        [seats, 0.5],
        [radio, 0.5],
        [radio, 1],
      ]),
    ]).summary() as { calibration: number; bins: unknown };
    assert.ok(Math.abs(calibration - (Math.abs(1.5 - 2) + Math.abs(1 - 0)) / 4) < 1e-12, String(calibration));
    assert.deepEqual(bins, [
      { frames: 3, probability: 0.5, pressed: 2 / 3 },
      { frames: 1, probability: 1, pressed: 0 },
    ]);
  });

  it("count the presses of each id, and keep the last thousand outcomes and lines", () => {
    const records = recorded(Array.from({ length: 1500 }, (_, i) => press(i % 3 ? seats : radio, 0, [], `line ${i}`)));
    assert.deepEqual([records.presses(radio), records.presses(seats)], [500, 1000]);
    assert.deepEqual([records.outcomes.length, records.lines().length, records.lines()[0]], [1000, 1000, "line 500"]);
    assert.equal(records.summary()?.presses, 1000);
  });
});
