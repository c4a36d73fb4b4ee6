/**
 * A road that shakes what is observed, as `npm run evaluate -- --shake` shakes recorded movements: on each axis the sum of eight waves whose
 * frequencies are within a fifth of the road's, with the variance of a sinusoid of its amplitude.
 */
import { random } from "whither/testing";

export interface Road {
  /** In the unit of length of what is shaken; 0: smooth. */
  readonly amplitude: number;
  /** In Hz. */
  readonly frequency: number;
}

const WAVES = 8;
const BAND = 0.2;

/** How far a road has moved what it shakes on each of so many axes, at a time in seconds; another seed, another road. */
export function shaker(seed: number, axes: number): (time: number, road: Road) => number[] {
  const next = random(seed);
  const waves = () => Array.from({ length: WAVES }, () => ({ share: 1 + BAND * (2 * next() - 1), phase: 2 * Math.PI * next() }));
  const all = Array.from({ length: axes }, waves);
  return (time, { amplitude, frequency }) =>
    all.map((axis) => {
      const sum = axis.reduce((total, { share, phase }) => total + Math.sin(2 * Math.PI * frequency * share * time + phase), 0);
      return (amplitude * sum) / Math.sqrt(WAVES);
    });
}
