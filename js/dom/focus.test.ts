import assert from "node:assert/strict";
import { describe, it } from "node:test";
import { listenToFocus } from "./focus.js";
import type { FindStopsAhead } from "./keyboard.js";
import type { Platform } from "./platform.js";
import { TestPage } from "./testing/page.js";

/** A page with a form of three tab stops whose focus is followed; `moved` has what got it, and what is ahead. */
async function follow(tabs: number, loading?: Promise<FindStopsAhead>) {
  const page = new TestPage({ core: () => assert.fail("no predictor is needed") });
  const form = page.append("form", { x: 0, y: 0, width: 300, height: 100 });
  const stops = [0, 100, 200].map((x) => page.append("input", { x, y: 0, width: 90, height: 30 }, { parent: form as never }));
  const ahead: FindStopsAhead = (focused, direction, most) => {
    if (direction === 0) return [];
    const after = direction > 0 ? stops : stops.toReversed();
    const at = after.indexOf(focused as Element);
    return after.slice(at + 1, at + 1 + most);
  };
  const moved: unknown[] = [];
  const failed: unknown[] = [];
  let loaded = 0;
  const platform = {
    listen: page.listen.bind(page),
    loadKeyboard() {
      loaded++;
      return loading ?? Promise.resolve(ahead);
    },
  } as unknown as Platform;
  const stop = listenToFocus(
    platform,
    page.window,
    tabs,
    (path, next) => moved.push([path[0] ?? null, [...next]]),
    (error) => failed.push(error),
  );
  await new Promise(setImmediate);
  const [first, second, third] = stops as [Element, Element, Element];
  return { page, form, first, second, third, moved, failed, loads: () => loaded, stop };
}

describe("focus", () => {
  it("is a path from the innermost node outwards, and empty where nothing has it", async () => {
    const page = new TestPage({ core: () => assert.fail("no predictor is needed") });
    const form = page.append("form", { x: 0, y: 0, width: 300, height: 100 });
    const field = page.append("input", { x: 0, y: 0, width: 90, height: 30 }, { parent: form as never });
    const paths: unknown[] = [];
    listenToFocus(page, page.window, 0, (path) => paths.push(path), assert.fail);
    page.dispatch("focusin", field);
    page.dispatch("focusout", field);
    assert.deepEqual(paths, [[field, form, page.document, page.window], []]);
  });

  it("is none that comes from a press, until a key is pressed", async () => {
    const { page, first, second, moved } = await follow(0);
    page.dispatch("pointerdown", first);
    page.dispatch("focusin", first);
    assert.deepEqual(moved, [[null, []]]);
    page.dispatch("keydown", first, { key: "Tab" });
    page.dispatch("focusin", second);
    assert.deepEqual(moved.at(-1), [second, []]);
  });

  it("leaves what had it, after a press too", async () => {
    const { page, first, moved } = await follow(0);
    page.dispatch("focusin", first);
    page.dispatch("pointerdown", null);
    page.dispatch("focusout", first);
    assert.deepEqual(moved, [
      [first, []],
      [null, []],
    ]);
  });

  it("moves from one element to the next without being nowhere between, and ends where it leaves the window", async () => {
    const { page, first, second, moved } = await follow(0);
    page.dispatch("focusin", first);
    page.dispatch("focusout", first, { relatedTarget: second });
    page.dispatch("focusin", second, { relatedTarget: first });
    assert.deepEqual(moved, [
      [first, []],
      [second, []],
    ]);
    page.dispatch("focusout", second, { relatedTarget: null });
    assert.deepEqual(moved.at(-1), [null, []]);
  });

  it("has so many stops ahead in the direction of the Tab key that moved it", async () => {
    const { page, first, second, third, moved } = await follow(2);
    for (const [shiftKey, focused] of [
      [false, first],
      [false, second],
      [true, third],
    ] as const) {
      page.dispatch("keydown", focused, { key: "Tab", shiftKey });
      page.dispatch("focusin", focused);
    }
    assert.deepEqual(moved, [
      [first, [second, third]],
      [second, [third]],
      [third, [second, first]],
    ]);
    const one = await follow(1);
    one.page.dispatch("keydown", one.first, { key: "Tab", shiftKey: false });
    one.page.dispatch("focusin", one.first);
    assert.deepEqual(one.moved, [[one.first, [one.second]]]);
  });

  it("has none ahead where no Tab key moved it: another key, or the page", async () => {
    const { page, first, second, moved } = await follow(2);
    page.dispatch("focusin", first);
    page.dispatch("keydown", first, { key: "Tab", shiftKey: false });
    page.dispatch("keydown", first, { key: "ArrowRight" });
    page.dispatch("focusin", second);
    assert.deepEqual(moved, [
      [first, []],
      [second, []],
    ]);
  });

  it("loads what finds tab stops only where these count, and reports where it cannot be loaded", async () => {
    assert.equal((await follow(0)).loads(), 0);
    assert.equal((await follow(1)).loads(), 1);
    const error = new Error("offline");
    const { page, first, moved, failed } = await follow(1, Promise.reject(error));
    assert.deepEqual(failed, [error]);
    page.dispatch("keydown", first, { key: "Tab", shiftKey: false });
    page.dispatch("focusin", first);
    assert.deepEqual(moved, [[first, []]]);
  });

  it("is followed no longer after the end", async () => {
    const { page, first, moved, stop } = await follow(1);
    stop();
    page.dispatch("focusin", first);
    assert.deepEqual([page.listening, moved], [0, []]);
  });
});
