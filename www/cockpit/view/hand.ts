/** A right hand that points, behind the place of its fingertip, on an arm that comes from the driver's elbow. */
import { ELBOW, type Position } from "../cabin.ts";
import { cross, minus, plus, times, unit } from "../vector.ts";
import type { Colour, Tube } from "./view.ts";

/** Behind the tip, to the right, and up, in mm. */
type Joint = readonly [behind: number, right: number, up: number];

const WRIST: Joint = [176, 20, 2];
/** How thick each part is, its radius in mm, and its joints. */
const PARTS: readonly { readonly radius: number; readonly joints: readonly Joint[] }[] = [
  // the index finger, then the curled ones
  {
    radius: 8,
    joints: [
      [8, 0, 0],
      [28, 0, 5],
      [54, 1, 10],
      [92, 2, 8],
    ],
  },
  {
    radius: 8.5,
    joints: [
      [76, 24, -26],
      [58, 22, -18],
      [60, 21, 4],
      [92, 21, 10],
    ],
  },
  {
    radius: 8.5,
    joints: [
      [82, 40, -28],
      [66, 39, -20],
      [68, 38, 0],
      [97, 38, 7],
    ],
  },
  {
    radius: 7.5,
    joints: [
      [92, 54, -27],
      [79, 53, -20],
      [81, 52, -3],
      [104, 52, 2],
    ],
  },
  // the thumb
  {
    radius: 9,
    joints: [
      [84, -22, -16],
      [104, -24, -9],
      [130, -10, -4],
    ],
  },
  // the back of the hand
  { radius: 13, joints: [[94, 4, 2], WRIST] },
  { radius: 13, joints: [[96, 21, 4], WRIST] },
  { radius: 12.5, joints: [[100, 37, 1], WRIST] },
  { radius: 11, joints: [[106, 50, -3], WRIST] },
  { radius: 13, joints: [[130, -8, -4], WRIST] },
];
const ARM = 27;

/** The tubes that it is made of. */
export function handAt(tip: Position, colour: Colour, sleeve: Colour): Tube[] {
  const behind = unit(minus(ELBOW, tip));
  const right = unit(cross([0, -1, 0], times(-1, behind)));
  const up = cross(times(-1, behind), right);
  const place = ([back, aside, high]: Joint) => plus(tip, plus(times(back, behind), plus(times(aside, right), times(high, up))));
  const parts = PARTS.map(({ radius, joints }): Tube => ({ points: joints.map(place), radius, colour }));
  const wrist = place(WRIST);
  const cuff = plus(wrist, times(46, unit(minus(ELBOW, wrist))));
  return [...parts, { points: [wrist, cuff], radius: 21, colour }, { points: [cuff, ELBOW], radius: ARM, colour: sleeve }];
}
