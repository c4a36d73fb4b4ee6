// Where a page's own tests run: a test runner with jsdom, which has less of the platform than any browser, and other classes.
import { test } from "node:test";
import assert from "node:assert/strict";
import { join } from "node:path";
import { capture, root } from "../../scripts/run.mjs";
import { project, write } from "./support.mjs";

const program = `
import * as whither from "whither";
import * as pointing from "whither/pointing";
import { watch } from "whither/dom";
import { fit } from "whither/study";

test("the surroundings are jsdom's", () => {
  expect(navigator.userAgent).toMatch(/jsdom/);
  expect(Blob.prototype.stream).toBe(undefined);
  expect(typeof IntersectionObserver + typeof ResizeObserver).toBe("undefinedundefined");
});

for (const [name, { init, pointerScenario, Predictor, PointerPredictor }] of Object.entries({ whither, pointing })) {
  test(name + " loads and predicts", async () => {
    await init();
    document.body.innerHTML = '<a id="near"></a><a id="far"></a>';
    const icons = [...document.querySelectorAll("a")].map(({ id }, i) => ({ id, x: 500 * i, y: 0, width: 9, height: 9 }));
    const predictor = PointerPredictor ? new PointerPredictor(icons) : new Predictor(pointerScenario(icons));
    for (let k = 0; k < 9; k++) predictor.observe(k / 60, [250 + 9 * k, 0]);
    expect(predictor.best.id).toBe("far");
  });
}

test("watch notices a press and the focus, and there is nothing to predict", async () => {
  document.body.innerHTML = '<a id="pressed" href="#"></a><a id="focused" href="#"></a>';
  const [intents, errors] = [[], []];
  const watcher = watch("a", {
    onIntent: ({ id, reason }) => void intents.push([id, reason]),
    onError: (error) => errors.push(error),
  });
  const [pressed, focused] = document.querySelectorAll("a");
  const at = (type, more) => {
    const options = { bubbles: true, composed: true, pointerType: "mouse", pointerId: 1, button: 0, ...more };
    return typeof PointerEvent === "function" ? new PointerEvent(type, options) : new MouseEvent(type, options);
  };
  for (let k = 0; k < 9; k++) document.body.dispatchEvent(at("pointermove", { clientX: 9 * k }));
  for (const type of ["pointerdown", "pointerup", "click"]) pressed.dispatchEvent(at(type));
  document.body.dispatchEvent(new KeyboardEvent("keydown", { key: "Tab", bubbles: true }));
  focused.focus();
  await watcher.ready;
  await new Promise((resolve) => setTimeout(resolve, 500));
  const { targets, best, none } = watcher;
  watcher.stop();
  expect(intents).toEqual([["pressed", "press"], ["focused", "focus"]]);
  expect(errors).toEqual([]);
  expect([targets, best, none]).toEqual([[pressed, focused], null, 1]);
});

test("fit loads", () => expect(fit([], {})).rejects.toMatchObject({ code: "out-of-range" }));
`;

test("vitest with jsdom", async (t) => {
  const { folder } = await project(t);
  write(folder, "page.test.js", program);
  for (const pool of ["forks", "threads"]) {
    await t.test(`in its pool of ${pool}`, async () => {
      const args = ["run", "--root", folder, "--environment", "jsdom", "--globals", "--pool", pool, "--no-color"];
      const { code, output } = await capture("node", [join(root, "node_modules/vitest/vitest.mjs"), ...args]);
      assert.equal(code, 0, output);
      assert.match(output, /Tests\s+5 passed/, output);
    });
  }
});
