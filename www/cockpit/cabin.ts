/**
 * Where everything is in the cockpit, in mm of the screen's frame: x to the right, y downwards, z towards the driver, from the
 * screen's upper left corner.
 */
import type { HandTarget } from "whither";
import { PLACES } from "../shared/places.ts";

/** x, y and z, in mm. */
export type Position = readonly [x: number, y: number, z: number];

const COLUMNS = 7;
/** From one icon to the next, and an icon's side. */
const PITCH = 40;
export const ICON = 24;

export const SCREEN = { width: COLUMNS * PITCH, height: (PLACES.length / COLUMNS) * PITCH } as const;

/** The 7 by 3 icons, in reading order. */
export const TARGETS: readonly HandTarget[] = PLACES.map(({ id }, index) => ({
  id,
  x: PITCH * ((index % COLUMNS) + 0.5),
  y: PITCH * (Math.floor(index / COLUMNS) + 0.5),
  width: ICON,
  height: ICON,
}));

export const LABELS: readonly string[] = PLACES.map(({ label }) => label);

/** The steering wheel, left of the screen and nearer to the driver; it leans back. */
export const WHEEL = { centre: [-290, 120, 250], radius: 180, lean: 0.4 } as const satisfies {
  centre: Position;
  radius: number;
  lean: number;
};

/** The gear lever, from its foot to its knob. */
export const LEVER: readonly [Position, Position] = [
  [70, 380, 190],
  [62, 262, 262],
];

/** Where a hand comes from: the rim of the wheel, and the knob. */
export const STARTS: readonly Position[] = [
  [-112, 150, 262],
  [62, 240, 268],
];

/** The driver's right elbow. */
export const ELBOW: Position = [-230, 330, 620];

/** The farthest that a visitor may take the hand: left, top, at the screen; right, bottom, towards the driver. */
export const REACH: readonly [Position, Position] = [
  [-160, -80, 0],
  [320, 300, 340],
];

export function isOn({ x, y, width, height }: HandTarget, [px, py]: Position): boolean {
  return Math.abs(px - x) <= width / 2 && Math.abs(py - y) <= height / 2;
}
