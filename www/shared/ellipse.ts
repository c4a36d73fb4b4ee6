/** One deviation of a Gaussian density in the plane. */

export interface Ellipse {
  readonly long: number;
  readonly short: number;
  readonly angle: number;
}

/** An ellipse longer than this share of the screen's diagonal carries no information. */
const TELLING = 0.09;

/** Whether it distinguishes places on a screen of this size. */
export function isInformative({ long }: Ellipse, width: number, height: number): boolean {
  return long <= TELLING * Math.hypot(width, height);
}

/** The principal axes of the position's covariance, one deviation long. */
export function ellipse(covariance: ArrayLike<number>, states: number): Ellipse {
  const xx = covariance[0] ?? 0;
  const xy = covariance[1] ?? 0;
  const yy = covariance[states + 1] ?? 0;
  const middle = (xx + yy) / 2;
  const spread = Math.hypot((xx - yy) / 2, xy);
  return {
    long: Math.sqrt(Math.max(0, middle + spread)),
    short: Math.sqrt(Math.max(0, middle - spread)),
    angle: Math.atan2(2 * xy, xx - yy) / 2,
  };
}
