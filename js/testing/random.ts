/**
 * Pseudo-random numbers that a seed repeats.
 *
 * @module
 */

/**
 * Numbers from 0 (included) to 1 (excluded), the same for the same seed everywhere: mulberry32.
 *
 * @param seed - Any number; neighbours have nothing in common.
 *
 * @example
 * ```ts
 * import { hand, random } from "whither/testing";
 *
 * const next = random(7);
 * const places = Array.from({ length: 100 }, () => ({ x: 1280 * next(), y: 720 * next() }));
 * const movements = places.slice(1).map((to, k) => hand(places[k] ?? to, to, { seed: k }));
 * ```
 */
export function random(seed: number): () => number {
  // all bits of the number count
  const [low = 0, high = 0] = new Uint32Array(new Float64Array([seed]).buffer);
  let state = Math.imul(low ^ 0x9e3779b9, 0x85ebca6b) ^ Math.imul(high ^ 0x7f4a7c15, 0xc2b2ae35);
  return () => {
    state = (state + 0x6d2b79f5) | 0;
    let mixed = Math.imul(state ^ (state >>> 15), state | 1);
    mixed ^= mixed + Math.imul(mixed ^ (mixed >>> 7), mixed | 61);
    return ((mixed ^ (mixed >>> 14)) >>> 0) / 2 ** 32;
  };
}

/** Numbers of mean 0 and deviation 1, made of those from 0 to 1 (Box and Muller). */
export function normal(uniform: () => number): () => number {
  return () => Math.sqrt(-2 * Math.log(1 - uniform())) * Math.cos(2 * Math.PI * uniform());
}
