import { WhitherError } from "#error";
import { fields, isAbsent } from "../core/read.js";
import type { Scenario, Vector } from "../core/scenario.js";
import { deviceScenario } from "./device.js";

/** The unit of angles. */
export type AngleUnit = "degrees" | "radians";

/** Something that a ray may be going to, as large as it appears from where the ray begins. */
export interface RayTarget {
  /** Its name; no two are the same. */
  readonly id: string;
  /** Its centre: the angle to the right, or the first coordinate on a {@link rayMap}. */
  readonly azimuth: number;
  /** Its centre: the angle upwards, or the second coordinate on a {@link rayMap}. */
  readonly elevation: number;
  /** The angle that it takes up from left to right. */
  readonly width: number;
  /** The angle that it takes up from bottom to top. */
  readonly height: number;
}

/** What the application chooses of a `rayScenario`. */
export interface RayOptions {
  /** The prior probability that the ray is going to none of the targets, from 0 to less than 1. @defaultValue 0 */
  readonly none?: number | undefined;
  /**
   * The largest amplitude, in `unit`, by which a moving car or a tremor is expected to shake the ray: how much it does, and how fast,
   * is followed, from movement to movement too. 0 expects none and costs nothing. What it gains was measured for pointers and hands
   * alone. @defaultValue 0
   */
  readonly shake?: number | undefined;
  /** The deviation of an observed angle, in `unit`: half a degree and more for an eye tracker. @defaultValue 0.05 degrees */
  readonly noise?: number | undefined;
  /** The unit of all angles, the observations' too. @defaultValue `"degrees"` */
  readonly unit?: AngleUnit | undefined;
}

/**
 * The tuned scenario for a ray that is turned, a controller's, the eyes' or one through a fingertip: its targets and everything else
 * filled in with constants that were measured on recorded rays. What is observed is `[azimuth, elevation]`, or a place on a
 * {@link rayMap}, which is better where rays start far below or above the targets.
 *
 * @param targets - What may be pointed at, by the angles of its centre and the angles that it takes up.
 * @param options - What the application chooses.
 * @throws {@link WhitherError} with the path of the field; `not-initialised` before `init()`.
 *
 * @example
 * ```ts
 * const predictor = new Predictor(
 *   rayScenario([
 *     { id: "lamp", azimuth: -30, elevation: 5, width: 6, height: 6 },
 *     { id: "door", azimuth: 30, elevation: 0, width: 10, height: 20 },
 *   ]),
 * );
 * predictor.observe(0, [-2, -40]);
 * ```
 */
export function rayScenario(targets: readonly RayTarget[], options?: RayOptions): Scenario {
  return deviceScenario(1, targets, options);
}

/**
 * Directions as places on a plane, by the azimuthal equidistant map: as far from its middle, and in the direction, in which the ray
 * has to be turned to get there. A degree is then as long in every direction about the middle, where a degree of azimuth grows shorter
 * the higher or lower the ray points, and there is no seam behind.
 *
 * Directions are vectors of any length, in a frame whose y axis points up, as WebXR's do.
 *
 * @param middle - A direction near the middle of the targets.
 * @param options - The `unit` of the angles, `"degrees"` by default.
 * @returns A function that gives the place of a direction: how far to the right and how far upwards of `middle`.
 * @throws {@link WhitherError} `wrong-length`, `out-of-range` for what has no direction; so does the function.
 *
 * @example
 * ```ts
 * const place = rayMap([0, 0, -1]); // ahead
 * console.log(place([0, 2, -2])); // [0, 45]
 * ```
 */
export function rayMap(
  middle: Vector,
  options?: { readonly unit?: AngleUnit | undefined },
): (direction: Vector) => [right: number, up: number] {
  if (!isAbsent(options)) fields(options, "options", ["unit"]);
  const unit = options?.unit ?? "degrees";
  const radian = unit === "degrees" ? 180 / Math.PI : 1;
  if (unit !== "degrees" && unit !== "radians")
    throw new WhitherError("out-of-range", "options.unit", `must be one of "degrees", "radians", got "${unit}"`);
  const ahead = unitVector(middle, "middle");
  const [x, y, z] = ahead;
  // straight up and down there is no right: any will do
  const across = Math.hypot(x, z);
  const right: Three = across > 1e-6 ? [-z / across, 0, x / across] : [1, 0, 0];
  const up: Three = [-right[2] * y, right[2] * x - right[0] * z, right[0] * y];
  return (direction) => {
    const to = unitVector(direction, "direction");
    const [aside, above] = [dot(to, right), dot(to, up)];
    const length = Math.hypot(aside, above);
    const angle = radian * Math.atan2(length, dot(to, ahead));
    return length > 0 ? [(angle * aside) / length, (angle * above) / length] : [angle, 0];
  };
}

type Three = readonly [number, number, number];

const dot = (a: Three, b: Three) => a[0] * b[0] + a[1] * b[1] + a[2] * b[2];

/** The vector of length one in the same direction. */
function unitVector(value: Vector, path: string): Three {
  const numbers = Array.from(value ?? []);
  if (numbers.length !== 3) throw new WhitherError("wrong-length", path, `must have 3 numbers, has ${numbers.length}`);
  const length = numbers.every(Number.isFinite) ? Math.hypot(...numbers) : 0;
  if (length > 0) return numbers.map((x) => x / length) as [number, number, number];
  throw new WhitherError("out-of-range", path, `must have finite numbers and a direction, got [${numbers.join(", ")}]`);
}
