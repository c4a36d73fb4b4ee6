import assert from "node:assert/strict";
import { describe, it } from "node:test";
import type { WhitherError } from "#error";
import { readElement, readHandleClose, readHeldOpen, readMenu } from "./options.js";

const root = {
  matches(selector: string) {
    if (selector.startsWith("[[")) throw new SyntaxError("not a selector");
    return false;
  },
} as Element;

/** `code at path: message` of what is thrown. */
function refusal(run: () => unknown): string {
  try {
    run();
  } catch (error) {
    const { code, path, message } = error as WhitherError;
    return `${code} at ${path || "-"}: ${message}`;
  }
  return "none";
}

const onClose = () => {};

describe("the options of whither/menu", () => {
  it("have the defaults that are documented", () => {
    const { release, none, bound, rest, delay } = readHeldOpen({ onClose });
    assert.deepEqual([release, none, bound, rest, delay], [0.25, 0.4, 1000, 150, 0]);
    assert.equal(readMenu(undefined, root).release, 0.25);
    assert.deepEqual([readHandleClose(undefined).release, readHandleClose({}).blockPointerEvents], [0.4, false]);
    assert.equal(readHeldOpen({ onClose, bound: undefined }).bound, 1000);
  });

  const wrong: [string, () => unknown][] = [
    ['missing-key at onClose: onClose: missing key "onClose"', () => readHeldOpen({})],
    ["wrong-type at options: options: must be an object, got a function", () => readHeldOpen(() => {})],
    ['wrong-type at onClose: onClose: must be a function, got "close"', () => readHeldOpen({ onClose: "close" })],
    [
      "out-of-range at release: release: must be greater than 0 and less than 1, got 1",
      () => readHeldOpen({ onClose, release: 1 }),
    ],
    ["out-of-range at none: none: must be at least 0 and less than 1, got -0.1", () => readMenu({ none: -0.1 }, root)],
    ["out-of-range at bound: bound: must be at least 0, got -1", () => readMenu({ bound: -1 }, root)],
    ["out-of-range at rest: rest: must be greater than 0, got 0", () => readHandleClose({ rest: 0 })],
    ["not-finite at delay: delay: must be a finite number, got NaN", () => readMenu({ delay: Number.NaN }, root)],
    ['out-of-range at items: items: must be a selector, got "[["', () => readMenu({ items: "[[" }, root)],
    ["wrong-type at signal: signal: must be an AbortSignal, got an object", () => readMenu({ signal: {} }, root)],
    ["wrong-type at trigger: trigger: must be an element, got nothing", () => readElement(null, "trigger")],
    [
      'unknown-key at buffer: buffer: unknown key "buffer", expected one of "release", "none", "bound", "rest", "constants", "predictor", "onError", "blockPointerEvents"',
      () => readHandleClose({ buffer: 1 }),
    ],
  ];
  for (const [expected, run] of wrong) it(`are refused: ${expected}`, () => assert.equal(refusal(run), expected));
});
