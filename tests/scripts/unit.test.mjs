// The check on the unit of `npm run bench`: a unit that measures something besides `Math.exp` is refused, loudly.
import { test } from "node:test";
import assert from "node:assert/strict";
import { interleave } from "../../benches/measure.mjs";
import { exponents } from "../../benches/scenarios.mjs";
import { checkUnit, sums, unit, ways } from "../../benches/yardstick.mjs";

const numbers = exponents(315);
const clock = () => {
  const { user, system } = process.cpuUsage();
  return (user + system) / 1000;
};
const measure = (entries) => interleave(entries, clock, { rounds: 5, least: 2, warmUp: 20 });

test("a unit that is slow on purpose is refused, whichever of the two ways it is", () => {
  const [plain, unrolled] = ways(numbers);
  const slow = ({ name, run }) => ({ name, run: (times) => [0, 1, 2].forEach(() => run(times)) });
  assert.throws(() => checkUnit("in this test", [measure([slow(plain), unrolled])]), /^Error: the unit is off, in this test: .* plain loop/);
  assert.throws(() => checkUnit("in this test", [measure([plain, slow(unrolled)])]), /^Error: the unit is off, in this test: .* apart/);
});

test("the fault of once, 14 ns beside 7.5, is refused, and so is what is no number", () => {
  assert.throws(() => checkUnit("in Node", [{ plain: 14, unrolled: 7.5 }]), /14\.00 ns in a plain loop and 7\.50 ns in an unrolled one, 1\.87 times/);
  assert.throws(() => checkUnit("in Node", [{ plain: NaN, unrolled: 7.5 }]), /the unit is off/);
});

test("one measurement of many that was disturbed is not, and the faster way is the unit", () => {
  const measured = [{ plain: 7.6, unrolled: 7.2 }, { plain: 30, unrolled: 7.2 }, { plain: 7.7, unrolled: 7.1 }];
  assert.deepEqual(checkUnit("in Node", measured), { plain: 7.7, unrolled: 7.2 });
  assert.equal(unit({ plain: 7.7, unrolled: 7.2 }), 7.2);
});

test("both ways add up the same exponentials, also where they are no multiple of four", () => {
  for (const count of [1, 4, 90, 315]) {
    const list = exponents(count);
    for (const { run } of ways(list)) run(1);
    const expected = list.reduce((sum, x) => sum + Math.exp(x), 0);
    for (const sum of Object.values(sums)) assert.ok(Math.abs(sum - expected) < 1e-12 * count, `${count}: ${sum}, ${expected}`);
  }
});
