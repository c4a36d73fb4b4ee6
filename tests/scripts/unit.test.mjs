// The check on the unit of `npm run bench`: a unit that measures something besides `Math.exp` is refused, loudly.
import { test } from "node:test";
import assert from "node:assert/strict";
import { interleave } from "../../benches/measure.mjs";
import { exponents } from "../../benches/scenarios.mjs";
import { check, checkUnit, sums, unit, ways } from "../../benches/yardstick.mjs";

const numbers = exponents(320);
const clock = () => {
  const { user, system } = process.cpuUsage();
  return (user + system) / 1000;
};
const measure = (entries) => interleave(entries, clock, { rounds: 5, least: 2, warmUp: 20 });
const slow = ({ name, run }) => ({ name, run: (times) => [0, 1, 2].forEach(() => run(times)) });

test("a unit that is slow on purpose is refused, and a check that is", () => {
  const both = measure([...ways(numbers).map(slow), check(numbers)]);
  assert.throws(
    () => checkUnit("in this test", [both], [both.check]),
    /^Error: the unit is off, in this test: a call of exp takes .* ns/,
  );
  const other = measure([...ways(numbers), slow(check(numbers))]);
  assert.throws(() => checkUnit("in this test", [other], [other.check]), /^Error: the unit is off, in this test: .* times apart/);
});

test("a unit of 14 ns where the check takes 7.5 is refused, and so is NaN", () => {
  const captured = { plain: 14, unrolled: 14 };
  assert.throws(
    () => checkUnit("in Node", [captured], [7.5]),
    /14\.00 ns where it is the unit, and 7\.50 ns .*, 1\.87 times apart/,
  );
  assert.throws(() => checkUnit("in Node", [{ plain: NaN, unrolled: 7.5 }], [7.5]), /the unit is off/);
});

test("one measurement of many that was disturbed does not count, and the faster loop is the unit", () => {
  const measured = [
    { plain: 7.6, unrolled: 7.2 },
    { plain: 30, unrolled: 30 },
    { plain: 7.7, unrolled: 7.1 },
  ];
  assert.deepEqual(checkUnit("in Node", measured, [7, 8]), { plain: 7.7, unrolled: 7.2, unit: 7.2, check: 7.5 });
  assert.equal(unit({ plain: 7.7, unrolled: 7.2 }), 7.2);
});

test("all add up the same exponentials, the loops also where they are no multiple of four", () => {
  for (const count of [1, 4, 90, 312]) {
    const list = exponents(count);
    const entries = count % 8 === 0 ? [...ways(list), check(list)] : ways(list);
    const expected = list.reduce((sum, x) => sum + Math.exp(x), 0);
    for (const { name, run } of entries) {
      run(1);
      assert.ok(Math.abs(sums[name] - expected) < 1e-12 * count, `${name}, ${count}: ${sums[name]}, ${expected}`);
    }
  }
});
