/** Where the targets are, and which one is asked for next. */
import type { Box } from "./movement.ts";

export const LAYOUTS = ["ring", "grid", "scatter"] as const;
export type Layout = (typeof LAYOUTS)[number];

/** The smallest side of a target, px: what a thumb needs. */
const LEAST = 44;
/** From a target to the rim of the field, px. */
const RIM = 14;
/** A prime number, so that steps across the ring come to each target. */
const ON_RING = 13;
const SCATTERED = 16;

/** The targets of a field of `width` by `height` px. */
export function targetsOf(layout: Layout, width: number, height: number): Box[] {
  const boxes = { ring, grid, scatter }[layout](width, height);
  return boxes.map(([x, y, w, h]) => [round(x), round(y), round(w), round(h)]);
}

/** The target that is asked for after `index`: across the ring, as ISO 9241-411 has it, elsewhere any other one. */
export function nextTarget(layout: Layout, index: number, count: number, random: () => number): number {
  const step = layout === "ring" ? (count - 1) / 2 : 1 + Math.floor(random() * (count - 1));
  return (index + step) % count;
}

function ring(width: number, height: number): Box[] {
  const across = Math.min(width, height);
  const size = Math.max(LEAST, across / 9);
  const radius = across / 2 - size / 2 - RIM;
  return Array.from({ length: ON_RING }, (_, k) => {
    const angle = (2 * Math.PI * k) / ON_RING - Math.PI / 2;
    return [width / 2 + radius * Math.cos(angle), height / 2 + radius * Math.sin(angle), size, size];
  });
}

function grid(width: number, height: number): Box[] {
  const [columns, rows] = width > height ? [7, 4] : [4, 6];
  const [across, down] = [(width - RIM) / columns, (height - RIM) / rows];
  const sides = [Math.max(LEAST, 0.62 * across), Math.max(LEAST, 0.5 * down)] as const;
  return Array.from({ length: columns * rows }, (_, k) => [
    RIM / 2 + across * ((k % columns) + 0.5),
    RIM / 2 + down * (Math.floor(k / columns) + 0.5),
    ...sides,
  ]);
}

/** Targets of any size at any place, none over another: the same ones for a field of the same size. */
function scatter(width: number, height: number): Box[] {
  const random = randomOf(11);
  const most = Math.max(LEAST, Math.min(width, height) / 5);
  const found: Box[] = [];
  for (let tries = 0; found.length < SCATTERED && tries < 4000; tries += 1) {
    const size = LEAST + (most - LEAST) * random() ** 2;
    const within = (side: number) => RIM + size / 2 + random() * (side - size - 2 * RIM);
    const box: Box = [within(width), within(height), size, size];
    const isClear = found.every(
      (other) => Math.max(Math.abs(other[0] - box[0]), Math.abs(other[1] - box[1])) > (other[2] + box[2]) / 2 + RIM,
    );
    if (isClear) found.push(box);
  }
  return found;
}

/** Numbers from 0 to 1, the same ones for the same seed: mulberry32. */
export function randomOf(seed: number): () => number {
  let state = seed;
  return () => {
    state = (state + 0x6d2b79f5) | 0;
    let mixed = Math.imul(state ^ (state >>> 15), state | 1);
    mixed ^= mixed + Math.imul(mixed ^ (mixed >>> 7), mixed | 61);
    return ((mixed ^ (mixed >>> 14)) >>> 0) / 2 ** 32;
  };
}

/** To a hundredth of a pixel: lines stay short. */
function round(x: number): number {
  return Math.round(100 * x) / 100;
}
