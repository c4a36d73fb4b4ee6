/** Simulated hand movements for the ghost pointer. */

/** In px. */
export interface Point {
  readonly x: number;
  readonly y: number;
}

/** A box by its centre and size, in px. */
export interface Box extends Point {
  readonly width: number;
  readonly height: number;
}

/** A pseudo-random number generator (mulberry32): the ghost makes the same movements for everybody. */
export function seeded(seed: number): () => number {
  let state = seed;
  return () => {
    state = (state + 0x6d2b79f5) | 0;
    let mixed = Math.imul(state ^ (state >>> 15), state | 1);
    mixed ^= mixed + Math.imul(mixed ^ (mixed >>> 7), mixed | 61);
    return ((mixed ^ (mixed >>> 14)) >>> 0) / 2 ** 32;
  };
}

/** Fitts's law, with the constants of an unhurried mouse (seconds). */
export function duration(from: Point, to: Point, size: number): number {
  return 0.25 + 0.16 * Math.log2(1 + Math.hypot(to.x - from.x, to.y - from.y) / size);
}

export interface Hand {
  readonly duration: number;
  /** Where the hand is `elapsed` seconds after it set out. */
  at(elapsed: number): Point;
}

/**
 * A minimum-jerk movement (Flash and Hogan 1985) along a slight arc, with a physiological tremor of 8 to 12 Hz, that takes `pace`
 * times as long as an unhurried one.
 */
export function reach(from: Point, to: Point, size: number, random: () => number, pace = 1): Hand {
  const total = pace * duration(from, to, size);
  const arc = (random() - 0.5) * 0.16;
  const waves = [0, 1].map(() => ({ frequency: 8 + 4 * random(), phase: 2 * Math.PI * random() }));
  const tremor = (wave: { frequency: number; phase: number } | undefined, elapsed: number) =>
    wave ? 0.5 * Math.sin(2 * Math.PI * wave.frequency * elapsed + wave.phase) : 0;
  return {
    duration: total,
    at(elapsed) {
      const share = Math.min(1, Math.max(0, elapsed / total));
      const along = share ** 3 * (10 - 15 * share + 6 * share ** 2);
      const aside = arc * Math.sin(Math.PI * along);
      return {
        x: from.x + along * (to.x - from.x) - aside * (to.y - from.y) + tremor(waves[0], elapsed),
        y: from.y + along * (to.y - from.y) + aside * (to.x - from.x) + tremor(waves[1], elapsed),
      };
    },
  };
}
