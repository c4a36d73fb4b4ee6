/** Numbers in words, the same everywhere on the page. */

export function percent(share: number): string {
  if (share > 0 && share < 0.005) return "<1%";
  if (share < 1 && share >= 0.995) return ">99%";
  return `${Math.round(share * 100)}%`;
}

export function seconds(time: number): string {
  return `${time.toFixed(2)} s`;
}
