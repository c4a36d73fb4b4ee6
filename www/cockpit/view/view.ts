/** What is drawn, in mm of the cockpit, and who draws it: WebGL where there is any, else a projection on a plain canvas. */
import type { Position } from "../cabin.ts";
import type { Camera } from "./camera.ts";

/** Red, green and blue from 0 to 255, and how opaque from 0 to 1. */
export type Colour = readonly [red: number, green: number, blue: number, alpha: number];

/** A flat, convex surface. */
export interface Patch {
  readonly corners: readonly Position[];
  readonly colour: Colour;
}

/** Light on the screen's plane, brightest in its middle. */
export interface Glow {
  readonly centre: Position;
  /** In mm. */
  readonly radius: number;
  readonly colour: Colour;
}

/** What is round: as a finger. */
export interface Tube {
  readonly points: readonly Position[];
  /** In mm. */
  readonly radius: number;
  readonly colour: Colour;
}

export interface Line {
  readonly points: readonly Position[];
  /** In px. */
  readonly width: number;
  readonly colour: Colour;
  /** How opaque it is at its first point, as a share of what it is at its last. @defaultValue 1 */
  readonly from?: number;
  /** Mark and gap, in mm. @defaultValue a line without gaps */
  readonly dash?: readonly [number, number];
}

/** In the order in which they are drawn; what is nearer hides what is behind it. */
export interface Shapes {
  readonly patches: readonly Patch[];
  readonly glows: readonly Glow[];
  /** Lines on the screen's plane: behind everything else. */
  readonly marks: readonly Line[];
  readonly tubes: readonly Tube[];
  readonly lines: readonly Line[];
}

export interface View {
  /** What it draws with, for who asks. */
  readonly kind: "webgl" | "plain";
  /** In CSS px, and the device's pixels in one of them. */
  resize(width: number, height: number, ratio: number): void;
  draw(shapes: Shapes, camera: Camera): void;
  free(): void;
}

/** A colour with another opacity. */
export function faded([red, green, blue, alpha]: Colour, share: number): Colour {
  return [red, green, blue, alpha * share];
}

/** From one colour, at share 0, to another, at share 1. */
export function mixed(a: Colour, b: Colour, share: number): Colour {
  const mix = (i: 0 | 1 | 2 | 3) => a[i] + share * (b[i] - a[i]);
  return [mix(0), mix(1), mix(2), mix(3)];
}

/** The marks of a dashed line, each a line; one without dashes as it is. */
export function dashes({ points, dash }: Line): readonly (readonly Position[])[] {
  const [a, b] = points;
  if (!dash || !a || !b) return [points];
  const [mark, gap] = dash;
  const size = Math.hypot(b[0] - a[0], b[1] - a[1], b[2] - a[2]);
  const at = (way: number): Position => {
    const share = Math.min(1, way / size);
    return [a[0] + share * (b[0] - a[0]), a[1] + share * (b[1] - a[1]), a[2] + share * (b[2] - a[2])];
  };
  const count = Math.ceil(size / (mark + gap));
  return Array.from({ length: count }, (_, k) => [at(k * (mark + gap)), at(k * (mark + gap) + mark)]);
}
