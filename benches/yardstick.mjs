// The unit of the tables, a call of `Math.exp`, measured in two ways that have to agree.
import { median } from "./measure.mjs";

/** So far apart the two ways may be. A sum that a closure captures, which V8 keeps in a box of its own, is 1.9 times off. */
const FACTOR = 1.3;

/** The last sums: what is kept cannot be left out by the compiler. */
export const sums = { plain: 0, unrolled: 0 };

/** Adds up the exponentials of all numbers so many times, one after another in a local sum. */
function plain(numbers, times) {
  let sum = 0;
  for (let k = 0; k < times; k++) {
    const less = k * 1e-9; // other numbers each time, so that no call can be left out
    for (let i = 0; i < numbers.length; i++) sum += Math.exp(numbers[i] - less);
  }
  return sum;
}

/** The same in four local sums at a time, so that no call waits for the addition before it. */
function unrolled(numbers, times) {
  let [a, b, c, d] = [0, 0, 0, 0];
  const blocks = numbers.length - (numbers.length % 4);
  for (let k = 0; k < times; k++) {
    const less = k * 1e-9;
    for (let i = 0; i < blocks; i += 4) {
      a += Math.exp(numbers[i] - less);
      b += Math.exp(numbers[i + 1] - less);
      c += Math.exp(numbers[i + 2] - less);
      d += Math.exp(numbers[i + 3] - less);
    }
    for (let i = blocks; i < numbers.length; i++) a += Math.exp(numbers[i] - less);
  }
  return a + b + c + d;
}

/** The two ways for `interleave`; one time of each is as many calls as there are numbers. */
export const ways = (numbers) => [
  { name: "plain", run: (times) => void (sums.plain = plain(numbers, times)) },
  { name: "unrolled", run: (times) => void (sums.unrolled = unrolled(numbers, times)) },
];

/** The unit, of `{ plain, unrolled }`: the faster way. */
export const unit = (times) => Math.min(times.plain, times.unrolled);

/**
 * The medians of a list of `{ plain, unrolled }`, nanoseconds a call. Fails where they are apart: then one of the two measures
 * something else besides, and no ratio to it means anything.
 */
export function checkUnit(where, measured) {
  const [one, other] = ["plain", "unrolled"].map((way) => median(measured.map((times) => times[way])));
  const apart = Math.max(one / other, other / one);
  if (!(apart <= FACTOR)) {
    throw new Error(
      `the unit is off, ${where}: a call of exp takes ${one.toFixed(2)} ns in a plain loop and ${other.toFixed(2)} ns in an ` +
        `unrolled one, ${apart.toFixed(2)} times apart; at most ${FACTOR} times is believed`,
    );
  }
  return { plain: one, unrolled: other };
}
