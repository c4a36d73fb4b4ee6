// examples/dom/links.html, which docs/links.md has word for word: a page over which Chromium's mouse moves.
import assert from "node:assert/strict";
import { readFileSync } from "node:fs";
import { test } from "node:test";
import { join } from "node:path";
import { launch } from "../../scripts/chromium.mjs";
import { root } from "../../scripts/run.mjs";
import { serve } from "../../scripts/serve.mjs";
import { movement } from "../browser/hand.mjs";
import { mouse, REST } from "./support.mjs";

const documentation = readFileSync(join(root, "docs/links.md"), "utf8");

test("the example is in the documentation word for word", () => {
  const page = readFileSync(join(root, "examples/dom/links.html"), "utf8");
  const [, script] = page.match(/<script type="module">\n(.*?) {4}<\/script>/s);
  assert.ok(documentation.includes(`\`\`\`js\n${script.replace(/^ {6}/gm, "").trim()}\n\`\`\``));
});

test("the documentation has each word of the rule for unsafe addresses", () => {
  const source = readFileSync(join(root, "js/links/unsafe.ts"), "utf8");
  const [, rule] = source.match(/const FIRST =\n(.*?);/s);
  const [, list] = documentation.match(/of a value of the query, as a word: (.*?);/s);
  assert.deepEqual(list.match(/\w+/g), rule.match(/\w+/g));
});

test("the example loads the page that the mouse goes to, and shows when a request is taken back", async (t) => {
  const host = await serve(root);
  const browser = await launch();
  t.after(async () => {
    await browser.close();
    await host.close();
  });
  const page = await browser.newPage({ viewport: { width: 1000, height: 700 } });
  const errors = [];
  page.on("pageerror", (error) => errors.push(String(error)));
  await page.goto(`${host.url}examples/dom/links.html`);
  const hand = await mouse(page);
  const go = async (href) => {
    const { x, y, width, height } = await page.locator(`a[href="${href}"]`).boundingBox();
    const [from, to] = [
      { x: 120, y: 560 },
      { x: x + width / 2, y: y + height / 2 },
    ];
    await hand.play([[0, from.x, from.y]]);
    await hand.rest(REST);
    await hand.play(movement(from, to, height, { seed: 3 }));
    return { to, from };
  };
  const lines = () => page.locator("#log li").allTextContents();
  await go("/logout");
  await go("list.html");
  const { to, from } = await go("store.html#top");
  await page.waitForFunction(() => [...log.children].some((line) => line.textContent.startsWith("store.html#top by rules")));
  await hand.play(movement(to, from, 60, { seed: 9 }));
  // taken back, or kept where this machine was slow
  await page.waitForFunction(() => {
    const [requested, used, wasted, cancelled] = stats.textContent.match(/\d+/g).map(Number);
    return used === 0 && requested > 0 && requested === wasted + cancelled;
  });
  const texts = await lines();
  assert.ok(
    texts.every((line) => !/logout|list/.test(line)),
    texts.join(),
  );
  assert.deepEqual(errors, []);
});
