import assert from "node:assert/strict";
import { describe, it } from "node:test";
import type { Box } from "./movement.ts";
import { hasExpected, Recorder } from "./recorder.ts";

const TARGET: Box = [100, 0, 20, 20];

/** Places on a line, at times in seconds. */
function recorded(...samples: (readonly [time: number, x: number])[]): Recorder {
  const recorder = new Recorder();
  for (const [time, x] of samples) recorder.add(time, x, 0);
  return recorder;
}

const samplesOf = (recorder: Recorder) => recorder.take(TARGET)?.samples.map(([time, x]) => [time, x]);

describe("the recorder", () => {
  it("gives what led to the target, from its first sample, and begins anew", () => {
    const recorder = recorded([5, 0], [5.1, 40], [5.2, 95]);
    assert.deepEqual(samplesOf(recorder), [
      [0, 0],
      [0.1, 40],
      [0.2, 95],
    ]);
    assert.equal(recorder.take(TARGET), null);
  });

  it("takes several places at one time for one, of the last, and what is old or has not moved for none", () => {
    const recorder = recorded([0, 0], [0.1, 10], [0.1, 20], [0.05, 7], [0.2, 20], [0.3, 30]);
    assert.deepEqual(samplesOf(recorder), [
      [0, 0],
      [0.1, 20],
      [0.3, 30],
    ]);
  });

  it("begins after the last rest outside of the target", () => {
    assert.deepEqual(samplesOf(recorded([0, 0], [0.1, 10], [0.6, 20], [0.7, 95])), [
      [0, 20],
      [0.1, 95],
    ]);
    // a rest on the target, and a hand that stirs on it, belong to the movement before
    assert.deepEqual(samplesOf(recorded([0, 0], [0.1, 95], [0.6, 96], [1.2, 97])), [
      [0, 0],
      [0.1, 95],
      [0.6, 96],
      [1.2, 97],
    ]);
  });

  it("keeps where the browser expected the pointer, as of the time of each sample", () => {
    const recorder = new Recorder();
    recorder.add(0, 0, 0);
    recorder.add(0.01, 10, 0);
    recorder.expect([30, 0]);
    recorder.add(0.02, 20, 0);
    const recording = recorder.take(TARGET);
    assert.deepEqual(recording?.expected, [null, [30, 0], [30, 0]]);
    assert.ok(recording && hasExpected(recording));
    const without = recorded([0, 0], [0.1, 5]).take(TARGET);
    assert.ok(without && !hasExpected(without));
  });
});
