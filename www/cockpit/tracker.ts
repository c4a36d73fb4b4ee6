/**
 * What a hand tracker reports, MediaPipe's landmarks or WebXR's joints, as samples `[seconds, x, y, z]` in mm of a screen's frame:
 * x to the right, y downwards, z towards the user, from its upper left corner. That is what `handScenario` of whither takes.
 */
import { WhitherError } from "whither";

export type Position = readonly [x: number, y: number, z: number];
export type Sample = readonly [seconds: number, x: number, y: number, z: number];

interface Point {
  readonly x: number;
  readonly y: number;
  readonly z: number;
}

/** Of MediaPipe's `HandLandmarkerResult`: for each hand its 21 landmarks, as shares of the picture and in metres about the hand. */
export interface Landmarks {
  readonly landmarks: readonly (readonly Point[])[];
  readonly worldLandmarks: readonly (readonly Point[])[];
}

/** The picture in which they were found; it must not be mirrored. */
export interface Picture {
  /** In px. */
  readonly width: number;
  readonly height: number;
  /** The camera's horizontal field of view, in degrees: what it errs by, the calibration takes back where the screen is. */
  readonly fieldOfView: number;
}

/** The tip of the index finger among the landmarks. */
const TIP = 8;

/**
 * The fingertip in the camera's frame, in metres: x to the right, y downwards, z away from the camera. Landmarks in metres have no
 * place; theirs is the one from which they would be where the picture has them, by least squares.
 *
 * @returns null without a hand.
 * @throws WhitherError `out-of-range` at `picture.fieldOfView`.
 */
export function tipOfLandmarks({ landmarks, worldLandmarks }: Landmarks, picture: Picture, hand = 0): Position | null {
  const [found, world] = [landmarks[hand], worldLandmarks[hand]];
  const tip = world?.[TIP];
  if (!found || !world || !tip) return null;
  const { fieldOfView } = picture;
  if (!(fieldOfView > 0 && fieldOfView < 180)) {
    throw new WhitherError("out-of-range", "picture.fieldOfView", `must be between 0 and 180 degrees, got ${fieldOfView}`);
  }
  const focal = picture.width / 2 / Math.tan((fieldOfView * Math.PI) / 360);
  // from the picture's middle, in focal lengths: (X + tx) = u (Z + tz), (Y + ty) = v (Z + tz)
  const u = found.map(({ x }) => ((x - 0.5) * picture.width) / focal);
  const v = found.map(({ y }) => ((y - 0.5) * picture.height) / focal);
  const right = world.map(({ x, z }, k) => (u[k] ?? 0) * z - x);
  const down = world.map(({ y, z }, k) => (v[k] ?? 0) * z - y);
  const away = -(covariance(u, right) + covariance(v, down)) / (covariance(u, u) + covariance(v, v));
  return [tip.x + mean(right) + mean(u) * away, tip.y + mean(down) + mean(v) * away, tip.z + away];
}

/**
 * The fingertip in the space of the pose, in metres.
 *
 * @param pose - `frame.getJointPose(hand.get("index-finger-tip"), space)`.
 * @returns null without a pose: the hand is lost.
 */
export function tipOfJoint(pose: { readonly transform: { readonly position: Point } } | null | undefined): Position | null {
  if (!pose) return null;
  const { x, y, z } = pose.transform.position;
  return [x, y, z];
}

/**
 * Places before a screen, in mm, of what has pressed three of its corners: the upper left, the upper right, the lower left one.
 *
 * @param corners - The fingertip at each press, in the tracker's own frame and unit.
 * @param size - The width and the height between those corners, in mm.
 * @throws WhitherError `out-of-range` at `corners` where they are none of a rectangle, and at `size`.
 */
export function screenFrame(
  corners: readonly [Position, Position, Position],
  size: { readonly width: number; readonly height: number },
): (tip: Position) => Position {
  if (!(size.width > 0 && size.height > 0)) {
    throw new WhitherError("out-of-range", "size", `must be greater than 0, got ${size.width} by ${size.height}`);
  }
  const [origin, upperRight, lowerLeft] = corners;
  const [across, along] = [minus(upperRight, origin), minus(lowerLeft, origin)];
  const [width, height] = [Math.hypot(...across), Math.hypot(...along)];
  const cosine = dot(across, along) / (width * height);
  // NaN where two are the same
  if (!(Math.abs(cosine) < 0.4)) {
    const degrees = Number.isNaN(cosine) ? "none" : `${Math.round((Math.acos(cosine) * 180) / Math.PI)} degrees`;
    throw new WhitherError("out-of-range", "corners", `must have a right angle at the first one, got ${degrees}`);
  }
  const right = times(1 / width, across);
  const normal = cross(along, right);
  const out = times(1 / Math.hypot(...normal), normal);
  const down = cross(right, out);
  const [wide, high] = [size.width / width, size.height / height];
  const scales = [wide, high, (wide + high) / 2] as const;
  return (tip) => {
    const from = minus(tip, origin);
    return [scales[0] * dot(right, from), scales[1] * dot(down, from), scales[2] * dot(out, from)];
  };
}

/** What is called back. */
export interface Callbacks {
  sample(sample: Sample): void;
  /** The movement is over: what comes next is another one. */
  end(reason: "touch" | "lost"): void;
}

/** A hand without a position for so many seconds is lost. */
const LOST = 0.5;
/** A hand touches from here on, and is off the screen again from there on, in mm. */
const TOUCH = 5;
const OFF = 30;

/** Cuts a tracker's frames into movements: one ends with a touch, or when the hand is lost. */
export class HandMovements {
  readonly #place: (tip: Position) => Position;
  readonly #callbacks: Callbacks;
  /** Seconds of the last position of this movement; null between movements. */
  #last: number | null = null;
  #touching = false;

  /** `place` is what `screenFrame` gives. */
  constructor(place: (tip: Position) => Position, callbacks: Callbacks) {
    this.#place = place;
    this.#callbacks = callbacks;
  }

  /** For every frame: its time, and the fingertip in the tracker's frame, null where there is none. A frame that comes twice counts once. */
  frame(milliseconds: number, tip: Position | null): void {
    const seconds = milliseconds / 1000;
    if (this.#last !== null && seconds - this.#last > LOST) this.#end("lost");
    if (!tip || (this.#last !== null && seconds <= this.#last)) return;
    const place = this.#place(tip);
    if (this.#touching && place[2] < OFF) return;
    this.#touching = place[2] <= TOUCH;
    this.#last = seconds;
    this.#callbacks.sample([seconds, ...place]);
    if (this.#touching) this.#end("touch");
  }

  #end(reason: "touch" | "lost"): void {
    this.#last = null;
    this.#callbacks.end(reason);
  }
}

function mean(list: readonly number[]): number {
  return list.reduce((sum, x) => sum + x, 0) / list.length;
}

function covariance(a: readonly number[], b: readonly number[]): number {
  const [meanA, meanB] = [mean(a), mean(b)];
  return mean(a.map((x, k) => (x - meanA) * ((b[k] ?? 0) - meanB)));
}

const minus = (a: Position, b: Position): Position => [a[0] - b[0], a[1] - b[1], a[2] - b[2]];
const times = (share: number, a: Position): Position => [share * a[0], share * a[1], share * a[2]];
const dot = (a: Position, b: Position): number => a[0] * b[0] + a[1] * b[1] + a[2] * b[2];
const cross = (a: Position, b: Position): Position => [
  a[1] * b[2] - a[2] * b[1],
  a[2] * b[0] - a[0] * b[2],
  a[0] * b[1] - a[1] * b[0],
];
