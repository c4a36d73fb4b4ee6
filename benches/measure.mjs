// Timing on a machine that does other things as well: everything that is compared runs in turn, round after round, and the
// median over the rounds counts.

/**
 * @param entries `{ name, run }`: `run(times)` does the work so many times.
 * @param clock Milliseconds, better of the processor than of the wall.
 * @returns Milliseconds for one time of each, by name.
 */
export function interleave(entries, clock, { rounds, least, warmUp }) {
  const all = entries.map((one) => ({ ...one, times: calibrate(one.run, clock, least, warmUp), measured: [] }));
  for (let round = 0; round < rounds; round++) {
    for (const entry of all) {
      const start = clock();
      entry.run(entry.times);
      entry.measured.push((clock() - start) / entry.times);
    }
  }
  return Object.fromEntries(all.map(({ name, measured }) => [name, median(measured)]));
}

/** How many times take at least `least` milliseconds, after `warmUp` of them: engines compile better what runs often. */
function calibrate(run, clock, least, warmUp) {
  const begin = clock();
  for (let times = 1; ; times *= 2) {
    let start = clock();
    run(times);
    if (clock() - start < least) continue;
    while (clock() - begin < warmUp) run(times);
    start = clock();
    run(times);
    const once = Math.max(clock() - start, 1e-3) / times;
    return Math.max(1, Math.ceil(least / once));
  }
}

export function median(numbers) {
  const sorted = [...numbers].sort((a, b) => a - b);
  const middle = sorted.length >> 1;
  return sorted.length % 2 === 1 ? sorted[middle] : (sorted[middle - 1] + sorted[middle]) / 2;
}

/** The straight line through points, and the share of the variance that it explains. */
export function line(points) {
  const mean = (of) => points.reduce((sum, point) => sum + of(point), 0) / points.length;
  const [mx, my] = [mean(([x]) => x), mean(([, y]) => y)];
  const sxy = mean(([x, y]) => (x - mx) * (y - my));
  const sxx = mean(([x]) => (x - mx) ** 2);
  const syy = mean(([, y]) => (y - my) ** 2);
  return { slope: sxy / sxx, intercept: my - (sxy / sxx) * mx, explained: sxy ** 2 / (sxx * syy) };
}
