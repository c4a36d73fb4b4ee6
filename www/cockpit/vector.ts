/** Positions and directions in three dimensions. */
import type { Position } from "./cabin.ts";

export const plus = (a: Position, b: Position): Position => [a[0] + b[0], a[1] + b[1], a[2] + b[2]];
export const minus = (a: Position, b: Position): Position => [a[0] - b[0], a[1] - b[1], a[2] - b[2]];
export const times = (share: number, a: Position): Position => [share * a[0], share * a[1], share * a[2]];
export const dot = (a: Position, b: Position): number => a[0] * b[0] + a[1] * b[1] + a[2] * b[2];
export const length = (a: Position): number => Math.hypot(...a);
export const unit = (a: Position): Position => times(1 / (length(a) || 1), a);
export const cross = (a: Position, b: Position): Position => [
  a[1] * b[2] - a[2] * b[1],
  a[2] * b[0] - a[0] * b[2],
  a[0] * b[1] - a[1] * b[0],
];
/** From `a`, at share 0, to `b`, at share 1. */
export const between = (a: Position, b: Position, share: number): Position => plus(a, times(share, minus(b, a)));
