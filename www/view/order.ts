/** The order of the rows. */

/** Two rows change places only when they differ by more than this, so that equals do not flicker. */
const MARGIN = 0.004;

/** Most probable first; near-equals keep the places that they had. */
export function reorder(order: readonly number[], probabilities: ArrayLike<number>): number[] {
  const result = [...order];
  const of = (index: number | undefined) => (index === undefined ? 0 : (probabilities[index] ?? 0));
  for (let sorted = 1; sorted < result.length; sorted += 1) {
    for (let at = sorted; at > 0 && of(result[at]) > of(result[at - 1]) + MARGIN; at -= 1) {
      const moved = result[at] as number;
      result[at] = result[at - 1] as number;
      result[at - 1] = moved;
    }
  }
  return result;
}
