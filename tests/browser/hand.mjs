// A simulated hand: minimum jerk (Flash and Hogan 1985), Fitts's law, a slight arc, a seeded physiological tremor.

/** Linear congruential, so that a failure can be had again. */
export function random(seed) {
  let state = seed >>> 0;
  return () => {
    state = (Math.imul(state, 1664525) + 1013904223) >>> 0;
    return state / 2 ** 32;
  };
}

/** Samples `[seconds, x, y]` from one place to another, up to a share of the movement's time. */
export function movement(from, to, size, { seed, rate = 100, share = 1 }) {
  const next = random(seed);
  for (let skipped = 0; skipped < 3; skipped += 1) next();
  const duration = 0.3 + 0.15 * Math.log2(1 + Math.hypot(to.x - from.x, to.y - from.y) / size);
  const arc = 0.12 * (next() - 0.5);
  const tremor = [0, 1].map(() => ({ hertz: 8 + 4 * next(), phase: 2 * Math.PI * next(), deviation: 0.4 + 0.4 * next() }));
  const shake = ({ hertz, phase, deviation }, time) => deviation * Math.sin(2 * Math.PI * hertz * time + phase);
  const samples = [];
  for (let time = 0; time <= duration * share + 1e-9; time += 1 / rate) {
    const part = Math.min(1, time / duration);
    const along = part ** 3 * (10 - 15 * part + 6 * part ** 2);
    const aside = arc * Math.sin(Math.PI * along);
    samples.push([
      time,
      from.x + along * (to.x - from.x) - aside * (to.y - from.y) + shake(tremor[0], time),
      from.y + along * (to.y - from.y) + aside * (to.x - from.x) + shake(tremor[1], time),
    ]);
  }
  return samples;
}
