import assert from "node:assert/strict";
import { test } from "node:test";
import { same } from "./same.js";

const call = () => {};

test("lists and plain objects are the same where their items are, and what is left out is as good as undefined", () => {
  for (const [one, other] of [
    [NaN, NaN],
    [call, call],
    [
      [1, [2]],
      [1, [2]],
    ],
    [{ hitSlop: { top: 1 } }, { hitSlop: { top: 1 }, prior: undefined }],
    [Object.create(null), {}],
  ]) {
    assert.ok(same(one, other), JSON.stringify([one, other]));
    assert.ok(same(other, one), JSON.stringify([other, one]));
  }
});

test("other values, other lengths, other kinds are not, nor objects of a class", () => {
  for (const [one, other] of [
    [0, -0],
    [0, "0"],
    [null, undefined],
    [{}, []],
    [[], { length: 0 }],
    [[1], [1, 2]],
    [[undefined], []],
    [{ a: 1 }, { a: 2 }],
    [() => {}, () => {}],
    [new Date(0), new Date(0)],
    [{ at: new Map() }, { at: new Map() }],
  ] as const) {
    assert.ok(!same(one, other), JSON.stringify([one, other]));
    assert.ok(!same(other, one), JSON.stringify([other, one]));
  }
});

test("what refers to itself is compared so deep and no deeper", () => {
  const loop = () => {
    const made: Record<string, unknown> = { a: 1 };
    return Object.assign(made, { itself: made });
  };
  assert.ok(!same(loop(), loop()));
});
