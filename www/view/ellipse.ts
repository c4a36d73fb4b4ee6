/** One deviation of a Gaussian density in the plane. */

/** The principal axes of the position's covariance, one deviation long. */
export function ellipse(covariance: ArrayLike<number>, states: number): { long: number; short: number; angle: number } {
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
