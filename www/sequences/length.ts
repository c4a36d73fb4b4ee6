/** A length in status. */
export function length(metres: number): string {
  if (metres < 995) return `${Number(metres.toPrecision(2))} m`;
  return `${(metres / 1000).toFixed(metres < 9950 ? 1 : 0)} km`;
}
