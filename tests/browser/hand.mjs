// The hand of the browser tests: whither/testing's, calm and unhurried, so that what is tested depends on little else.
import { hand } from "whither/testing";

/**
 * A fiftieth of a person's noise, so that one movement gets to the middle but for a few pixels; three quarters of a second for the width of a
 * screen; a sample at each moment, as from a pen.
 */
const CALM = { noise: 0.02, pace: 4, dwell: 0, resolution: 0 };

/** Samples `[seconds, x, y]` from one place to the middle of a target, up to a share of their time. */
export function movement(from, { x, y }, size, { seed, rate = 100, share = 1 }) {
  const samples = hand({ x: from.x, y: from.y }, { x, y }, { ...CALM, size, seed, rate });
  const [end] = samples.at(-1);
  return samples.filter(([time]) => time <= share * end);
}
