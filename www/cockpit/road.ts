/** The road: what shakes the hand, on each axis alike. */
import { random } from "whither/testing";
import type { Position } from "./cabin.ts";

export interface Road {
  /** The deviation on each axis, in mm: .71 of the amplitude. */
  readonly deviation: number;
  /** In Hz. */
  readonly frequency: number;
}

/** Frequencies lie within this share of the road's. */
const SPREAD = 0.2;
const WAVES = 8;

/** How far the hand is shaken at any time in seconds: on each axis a sum of eight waves, as in `npm run evaluate -- --shake`. */
export function shaking({ deviation, frequency }: Road, seed: number): (seconds: number) => Position {
  const uniform = random(seed);
  const axis = () =>
    Array.from({ length: WAVES }, () => ({
      rate: 2 * Math.PI * frequency * (1 + SPREAD * (2 * uniform() - 1)),
      phase: 2 * Math.PI * uniform(),
    }));
  const axes = [axis(), axis(), axis()] as const;
  const height = deviation / Math.sqrt(WAVES / 2);
  return (seconds) => {
    const sum = (waves: (typeof axes)[0]) =>
      height * waves.reduce((total, { rate, phase }) => total + Math.sin(rate * seconds + phase), 0);
    return [sum(axes[0]), sum(axes[1]), sum(axes[2])];
  };
}
