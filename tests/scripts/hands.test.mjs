// The figures of `npm run hands`, of movements whose figures are known.
import assert from "node:assert/strict";
import { describe, it } from "node:test";
import { figuresOf, ROWS } from "../../scripts/hand-figures.mjs";

const target = { targets: [[400, 0, 40, 40]], target: 0 };

/** Samples every 10 ms of a place for each time. */
const track = (seconds, place) => ({
  ...target,
  samples: Array.from({ length: Math.round(100 * seconds) + 1 }, (_, k) => [k / 100, ...place(k / 100)]),
});

const close = (value, expected, within) => assert.ok(Math.abs(value - expected) <= within, `${value}, expected ${expected}`);

describe("the figures of a movement", () => {
  it("at one speed on a straight line", () => {
    // 400 px/s: the box begins at 380 px
    const figures = figuresOf(track(1, (time) => [400 * time, 0]));
    close(figures.duration, 0.95, 0.011);
    close(figures.dwell, 0.05, 0.011);
    close(figures.bits, Math.log2(11), 1e-12);
    close(figures.peak, 400, 1);
    close(figures.peakToMean, 1, 0.01);
    for (const tenth of figures.profile) close(tenth, 1, 0.01);
    close(figures.length, 0.95, 0.03);
    assert.deepEqual(
      [figures.missed, figures.returned, figures.beyond, figures.aside, figures.heading],
      [false, false, false, 0, 0],
    );
  });

  it("in two parts, beyond the target and back", () => {
    // to 700 px in 0.4 s, a stop of 0.2 s, back to 400 px in 0.4 s, by cosines
    const ease = (share) => (1 - Math.cos(Math.PI * Math.min(1, Math.max(0, share)))) / 2;
    const figures = figuresOf(track(1.2, (time) => [700 * ease(time / 0.4) - 300 * ease((time - 0.6) / 0.4), 0]));
    assert.deepEqual([figures.peaks, figures.beyond, figures.returned], [2, true, true]);
    close(figures.peak, (700 * Math.PI) / 2 / 0.4, 90);
    close(figures.peakAt * figures.duration, 0.2, 0.02);
  });

  it("aside of the line, in the wrong direction at first, and pressed outside", () => {
    const figures = figuresOf(
      track(1, (time) => (time < 0.5 ? [0, 400 * time] : [800 * (time - 0.5), time > 0.95 ? 200 : 200 - 400 * (time - 0.5)])),
    );
    assert.equal(figures.missed, true);
    close(figures.aside, 0.5, 0.02);
    close(figures.heading, 90, 15);
  });

  it("none where it is in the target from the beginning", () => {
    assert.equal(figuresOf(track(1, () => [400, 0])), null);
  });

  it("a device that reports nothing has stayed where it was", () => {
    const samples = [
      [0, 0, 0],
      [0.1, 100, 0],
      [0.6, 200, 0],
      [0.7, 400, 0],
    ];
    const figures = figuresOf({ ...target, samples });
    assert.equal(figures.peaks, 3);
  });

  it("Fitts's law over sets of several distances, and not over one", () => {
    const [, of] = ROWS.find(([name]) => name.startsWith("Fitts"));
    const all = [1, 2, 3, 4].map((bits) => ({ bits, duration: 0.2 + 0.1 * bits }));
    assert.equal(of(all), "0.20 + 0.100");
    assert.equal(of(all.slice(0, 1)), "one distance");
  });
});
