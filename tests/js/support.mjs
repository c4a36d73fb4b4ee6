// What the tests of the built package share.
import assert from "node:assert/strict";
import { readFileSync } from "node:fs";
import { WhitherError } from "whither";

/** What a file in `tests/` holds. */
export function read(path) {
  return JSON.parse(readFileSync(new URL(`../${path}`, import.meta.url), "utf8"));
}

/** The golden case of this name. */
export const golden = (name) => read(`golden/${name}.json`);

/**
 * A copy with changes: JSON pointers and what is put there, `null` for nothing. In what is put, `"NaN"`, `"Infinity"` and
 * `"-Infinity"` are numbers, and `["*1002", x]` is a list of so many `x`. As `change` in tests/native/support.rs.
 */
export function changed(value, changes) {
  if ("" in changes) return put(changes[""]);
  const copy = put(value);
  for (const [pointer, given] of Object.entries(changes)) {
    const keys = pointer.split("/").slice(1);
    const last = keys.pop();
    keys.reduce((parent, key) => parent[key], copy)[last] = put(given);
  }
  return copy;
}

function put(given) {
  if (typeof given === "string" && /^(NaN|-?Infinity)$/.test(given)) return Number(given);
  if (given === null || typeof given !== "object") return given;
  if (!Array.isArray(given)) return Object.fromEntries(Object.entries(given).map(([key, item]) => [key, put(item)]));
  const [count, item] = given;
  return /^\*\d+$/.test(count) ? new Array(Number(count.slice(1))).fill(put(item)) : given.map(put);
}

/** The scenario of a golden case, with another method. */
export function scenarioOf({ motion, observation, initial, arrival, quadrature, destinations }, method) {
  return { motion, observation, initial, arrival, quadrature, destinations, method };
}

/** A small scenario to be changed by tests. */
export function small(changes = {}) {
  return {
    motion: { type: "constantVelocity", dimensions: 2, noise: 300 },
    observation: { noise: 1.5 },
    initial: { velocity: 1000 },
    arrival: { type: "uniform", from: 0.5, to: 3 },
    destinations: [
      { id: "left", center: [0, 300], size: [80, 80] },
      { id: "middle", center: [400, 0], size: [80, 80], prior: 2 },
      { id: "right", center: [800, 300], size: [80, 80] },
    ],
    ...changes,
  };
}

/** A movement to the right: `[time, x, y]`. */
export const movement = Array.from({ length: 20 }, (_, k) => [2 + 0.016 * k, 400 + 12 * k, 300 + (k % 3)]);

/** Asserts numbers within `tolerance` of `1 + |expected|`; null is minus infinity, as in the golden cases. */
export function close(found, expected, tolerance, what) {
  assert.equal(found.length, expected.length, `${what}: length`);
  for (let i = 0; i < expected.length; i++) {
    const wanted = expected[i] ?? -Infinity;
    const difference = found[i] === wanted ? 0 : Math.abs(found[i] - wanted) / (1 + Math.abs(wanted));
    assert.ok(difference <= tolerance, `${what}[${i}]: ${found[i]}, expected ${wanted}`);
  }
}

/** Asserts the same numbers to the bit. */
export function same(found, expected, what) {
  assert.deepEqual(
    new BigUint64Array(Float64Array.from(found).buffer),
    new BigUint64Array(Float64Array.from(expected).buffer),
    what,
  );
}

/** Asserts that `run` throws our error: its code, and its message, which begins with its path. */
export function refuses(run, code, path, message) {
  let error;
  try {
    run();
  } catch (thrown) {
    error = thrown;
  }
  assert.ok(error instanceof WhitherError, `no WhitherError but ${error}`);
  const found = { code: error.code, path: error.path, message: error.message };
  assert.deepEqual(found, { code, path, message: path === "" ? message : `${path}: ${message}` });
}
