/** Where an arrow key leads. */

/** Left and right walk in reading order, up and down by a row, Home and End to the first and last. */
export function destinationOf(key: string, here: number, columns: number, count: number): number | null {
  const steps: Record<string, number> = { ArrowRight: 1, ArrowLeft: -1, ArrowDown: columns, ArrowUp: -columns };
  const limits: Record<string, number> = { Home: 0, End: count - 1 };
  const next = limits[key] ?? here + (steps[key] ?? Number.NaN);
  return next >= 0 && next < count ? next : null;
}
