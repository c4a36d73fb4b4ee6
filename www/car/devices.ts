/** What people point with in a car: what is observed of each, and how. */
import { random } from "whither/testing";
import type { Point } from "./geometry.ts";
import { shaker, type Road } from "../shared/road.ts";

export type DeviceName = "mouse" | "touch" | "air";

export interface Device {
  readonly name: DeviceName;
  readonly label: string;
  /** Whether it is observed on the glass alone, where lifting it selects. */
  readonly contact: boolean;
  /** Seconds between two observations at least. */
  readonly interval: number;
  /** The deviation of what a tracker adds to each, in px. */
  readonly noise: number;
}

export const DEVICES: readonly Device[] = [
  { name: "mouse", label: "Mouse", contact: false, interval: 0, noise: 0 },
  { name: "touch", label: "Finger on the glass", contact: true, interval: 0, noise: 0 },
  // what cameras that track hands give: some sixty positions a second, some mm off
  { name: "air", label: "Hand in mid-air", contact: false, interval: 1 / 60, noise: 3 },
];

/** What is pointed with, and over which road. */
export interface Ride extends Road {
  readonly device: DeviceName;
}

/** Seconds on the page's clock, and px of the viewport. */
export interface Sample extends Point {
  readonly time: number;
}

export function deviceOf({ device }: Ride): Device {
  const found = DEVICES.find(({ name }) => name === device);
  if (!found) throw new RangeError(`No device is called ${device}.`);
  return found;
}

/** What is observed of where a hand would be without road and tracker; the same seed, the same road and noise. */
export function observer(seed: number): (hand: Sample, ride: Ride) => Sample | null {
  const shaken = shaker(seed, 2);
  const next = random(seed + 1);
  let last = Number.NEGATIVE_INFINITY;
  return (hand, ride) => {
    const { interval, noise } = deviceOf(ride);
    if (hand.time >= last && hand.time - last < interval) return null;
    last = hand.time;
    const [x = 0, y = 0] = shaken(hand.time, ride);
    const [across, down] = [normal(next), normal(next)];
    return { time: hand.time, x: hand.x + x + noise * across, y: hand.y + y + noise * down };
  };
}

/** Box and Muller's: of two uniform variables a normal one. */
function normal(next: () => number): number {
  return Math.sqrt(-2 * Math.log(1 - next())) * Math.cos(2 * Math.PI * next());
}
