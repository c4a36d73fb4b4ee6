/**
 * A road that shakes what is observed, as `npm run evaluate -- --shake` shakes recorded movements: on each axis the sum of eight waves whose
 * frequencies are within a fifth of the road's, with the variance of a sinusoid of its amplitude.
 */
import { random } from "whither/testing";
import type { Point } from "./geometry.ts";

export interface Road {
  /** In px; 0: smooth. */
  readonly amplitude: number;
  /** In Hz. */
  readonly frequency: number;
}

const WAVES = 8;
const BAND = 0.2;

/** Where a road has moved what it shakes, at a time in seconds; another seed, another road. */
export function shaker(seed: number): (time: number, road: Road) => Point {
  const next = random(seed);
  const waves = () => Array.from({ length: WAVES }, () => ({ share: 1 + BAND * (2 * next() - 1), phase: 2 * Math.PI * next() }));
  const [across, down] = [waves(), waves()];
  return (time, { amplitude, frequency }) => {
    const along = (axis: typeof across) =>
      (amplitude * axis.reduce((sum, { share, phase }) => sum + Math.sin(2 * Math.PI * frequency * share * time + phase), 0)) /
      Math.sqrt(WAVES);
    return { x: along(across), y: along(down) };
  };
}
