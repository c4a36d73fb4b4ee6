/** The order of the rows: most probable first, equals in reading order. */
export function ranking(probabilities: ArrayLike<number>): number[] {
  const order = Array.from(probabilities, (_, index) => index);
  return order.sort((a, b) => (probabilities[b] ?? 0) - (probabilities[a] ?? 0));
}
