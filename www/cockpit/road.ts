/** The road, by the deviation of what it does to the hand. */
import { shaker } from "../shared/road.ts";
import type { Position } from "./cabin.ts";

export interface Road {
  /** The deviation on each axis, in mm: .71 of the amplitude. */
  readonly deviation: number;
  /** In Hz. */
  readonly frequency: number;
}

/** How far the hand is shaken at any time in seconds, on each axis alike. */
export function shaking({ deviation, frequency }: Road, seed: number): (seconds: number) => Position {
  const shake = shaker(seed, 3);
  const road = { amplitude: Math.SQRT2 * deviation, frequency };
  return (seconds) => {
    const [x = 0, y = 0, z = 0] = shake(seconds, road);
    return [x, y, z];
  };
}
