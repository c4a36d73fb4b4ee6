// The programs in examples/, as a newcomer runs them.
import assert from "node:assert/strict";
import { readFileSync } from "node:fs";
import { join } from "node:path";
import { test } from "node:test";
import { launch } from "../../scripts/chromium.mjs";
import { capture, root } from "../../scripts/run.mjs";
import { serve } from "../../scripts/serve.mjs";
import { project, write } from "./support.mjs";

/** What both programs about a vessel print at the end. */
const VESSEL = "9 min: Cowes 0.61, there after 36 min";

async function lastLine(program, args, options) {
  const { code, output } = await capture(program, args, options);
  assert.equal(code, 0, output);
  return output.trim().split("\n").at(-1);
}

test("examples in Rust", async (t) => {
  const example = (name) => lastLine("cargo", ["run", "--quiet", "--example", name]);
  await t.test("pointer", async () => assert.equal(await example("pointer"), "100% of the time: map   0.98"));
  await t.test("vessel", async () => assert.equal(await example("vessel"), VESSEL));
});

test("the example in Node, with the packed package", async (t) => {
  const { folder } = await project(t);
  write(folder, "node.mjs", readFileSync(join(root, "examples/node.mjs"), "utf8"));
  assert.equal(await lastLine("node", ["node.mjs"], { cwd: folder }), VESSEL);
});

test("the example on a page lights the button that the mouse goes to", async (t) => {
  const server = await serve(root);
  t.after(() => server.close());
  const browser = await launch();
  t.after(() => browser.close());
  const page = await browser.newPage({ viewport: { width: 1280, height: 800 } });
  const errors = [];
  page.on("pageerror", (error) => errors.push(String(error)));
  await page.goto(`${server.url}examples/page/`);
  await page.waitForSelector("[data-ready]");
  const { x, y } = await page.locator("#map").boundingBox();
  await page.mouse.move(640, 400);
  await page.mouse.move(x + 40, y + 40, { steps: 20 });
  await page.waitForSelector("#map.next");
  assert.equal(await page.locator(".next").count(), 1);
  assert.deepEqual(errors, []);
});
