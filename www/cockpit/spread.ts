/** Where names go that would stand on one another. */

/** Heights at least `gap` apart, as near as can be to what they were, which ascends. */
export function spread(heights: readonly number[], gap: number, top: number, bottom: number): number[] {
  const found: number[] = [];
  for (const height of heights) found.push(Math.max(height, (found.at(-1) ?? top - gap) + gap));
  const over = (found.at(-1) ?? 0) - bottom;
  if (over <= 0) return found;
  let limit = bottom;
  for (let k = found.length - 1; k >= 0; k -= 1) {
    found[k] = Math.min(found[k] ?? 0, limit);
    limit = (found[k] ?? 0) - gap;
  }
  return found;
}
