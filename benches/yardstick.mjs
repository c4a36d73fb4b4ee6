// The unit of the tables, a call of `Math.exp`: the faster of two loops, checked by a third that is used for nothing else.
import { median } from "./measure.mjs";

/** So far apart unit and check may be. A sum that a closure captures, which V8 keeps in a box of its own, is 1.9 to 2.8 times off. */
const FACTOR = 1.4;

/** The last sums: what is kept cannot be left out by the compiler. */
export const sums = { plain: 0, unrolled: 0, check: 0 };

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

/** The two loops for `interleave`; one time of each is as many calls as there are numbers. */
export const ways = (numbers) => [
  { name: "plain", run: (times) => void (sums.plain = plain(numbers, times)) },
  { name: "unrolled", run: (times) => void (sums.unrolled = unrolled(numbers, times)) },
];

/** The unit, of `{ plain, unrolled }`: V8 keeps the sum of either in memory at times. */
export const unit = (times) => Math.min(times.plain, times.unrolled);

/** The check: eight local sums, numbers that stay as they are. */
export const check = (numbers) => ({
  name: "check",
  run(times) {
    let [a, b, c, d, e, f, g, h] = [0, 0, 0, 0, 0, 0, 0, 0];
    for (let k = 0; k < times; k++) {
      for (let i = 0; i + 7 < numbers.length; i += 8) {
        a += Math.exp(numbers[i]);
        b += Math.exp(numbers[i + 1]);
        c += Math.exp(numbers[i + 2]);
        d += Math.exp(numbers[i + 3]);
        e += Math.exp(numbers[i + 4]);
        f += Math.exp(numbers[i + 5]);
        g += Math.exp(numbers[i + 6]);
        h += Math.exp(numbers[i + 7]);
      }
    }
    sums.check = a + b + c + d + e + f + g + h;
  },
});

/**
 * The medians of what calls took, in nanoseconds: a list of `{ plain, unrolled }`, and one of the check. Fails where unit and check
 * are apart: then one of them measures something else besides, and no ratio means anything.
 */
export function checkUnit(where, measured, checks) {
  const found = median(measured.map(unit));
  const expected = median(checks);
  const apart = Math.max(found / expected, expected / found);
  if (!(apart <= FACTOR)) {
    throw new Error(
      `the unit is off, ${where}: a call of exp takes ${found.toFixed(2)} ns where it is the unit, and ${expected.toFixed(2)} ns ` +
        `in an unrolled loop over an array, ${apart.toFixed(2)} times apart; at most ${FACTOR} times is accepted`,
    );
  }
  const way = (name) => median(measured.map((times) => times[name]));
  return { plain: way("plain"), unrolled: way("unrolled"), unit: found, check: expected };
}
