import assert from "node:assert/strict";
import { before, describe, it } from "node:test";
import { init } from "whither";
import { METHODS } from "./methods.ts";
import { Scorer, SHARES } from "./score.ts";
import { type Row, summary } from "./summary.ts";

const ROAD = { deviation: 4, frequency: 6 };
const COUNT = 12;

/** Without what depends on the machine. */
const numbers = (rows: readonly Row[]) => rows.map(({ right, time, loss, difference }) => ({ right, time, loss, difference }));

describe("the methods over simulated gestures", () => {
  let rows: Row[];
  const row = (id: string) => rows[METHODS.findIndex((method) => method.id === id)] as Row;
  const scored = () => {
    const scorer = new Scorer(ROAD);
    return summary(Array.from({ length: COUNT }, (_, k) => scorer.score(1000 + k)));
  };
  before(async () => {
    await init();
    rows = scored();
  });

  it("give the same numbers for the same seeds", () => {
    assert.deepEqual(numbers(scored()), numbers(rows));
  });

  it("agree where they are equal, and differ where they are not", () => {
    for (const { id, same } of METHODS.filter((method) => method.same)) {
      assert.ok(row(id).difference < 1e-9, `${id}: ${row(id).difference}`);
      assert.ok(Math.abs((row(id).loss ?? 0) - (row(same ?? "").loss ?? 1)) < 1e-9, id);
      assert.deepEqual(row(id).right, row(same ?? "").right);
    }
    assert.ok(Math.abs((row("bridging").loss ?? 0) - (row("pseudoObservation").loss ?? 0)) > 1e-3);
  });

  it("begin at a guess, and know most icons before the end", () => {
    for (const id of ["shake", "pseudoObservation", "bridging"]) {
      const { right, loss } = row(id);
      assert.equal(right.length, SHARES.length);
      assert.ok((right[0] ?? 1) < 0.35 && (right.at(-2) ?? 0) > 0.6, `${id}: ${right}`);
      const mean = right.reduce((sum, share) => sum + share, 0) / right.length;
      assert.ok(Math.abs(row(id).time - mean) < 0.05, `${row(id).time} of the time, ${mean} at the shares`);
      assert.ok(loss !== null && loss < Math.log(21), `${id}: ${loss}`);
    }
    assert.equal(row("nearest").loss, null);
  });
});
