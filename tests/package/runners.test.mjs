// Where a page's own tests run: a test runner with jsdom, which has less of the platform than any browser, and other classes.
import { test } from "node:test";
import assert from "node:assert/strict";
import { join } from "node:path";
import { capture, root } from "../../scripts/run.mjs";
import { project, write } from "./support.mjs";

const program = `
import * as whither from "whither";
import * as pointing from "whither/pointing";
import { fit } from "whither/study";

test("the surroundings are jsdom's", () => {
  expect(navigator.userAgent).toMatch(/jsdom/);
  expect(Blob.prototype.stream).toBe(undefined);
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
      assert.match(output, /Tests\s+4 passed/, output);
    });
  }
});
