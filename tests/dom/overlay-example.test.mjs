// The page examples/dom/overlay.html, which docs/overlay.md shows, and the line for the console.
import assert from "node:assert/strict";
import { readFileSync } from "node:fs";
import { after, before, describe, it } from "node:test";
import { join } from "node:path";
import { launch } from "../../scripts/chromium.mjs";
import { root } from "../../scripts/run.mjs";
import { serve } from "../../scripts/serve.mjs";
import { movement } from "../browser/hand.mjs";
import { mouse } from "./support.mjs";

describe("the page that looks inside", () => {
  let host, browser;
  before(async () => {
    host = await serve(root);
    browser = await launch();
  });
  after(async () => {
    await browser?.close();
    await host?.close();
  });

  it("is in the documentation word for word", () => {
    const text = readFileSync(join(root, "docs/overlay.md"), "utf8");
    const page = readFileSync(join(root, "examples/dom/overlay.html"), "utf8");
    const [, script] = page.match(/<script type="module">\n(.*?) {4}<\/script>/s);
    assert.ok(text.includes(`\`\`\`js\n${script.replace(/^ {6}/gm, "").trim()}\n\`\`\``));
  });

  it("loads the overlay when it is asked for, and a line in the console starts it too", async () => {
    const page = await browser.newPage({ viewport: { width: 1280, height: 760 } });
    const errors = [];
    const requests = [];
    page.on("pageerror", (error) => errors.push(String(error)));
    page.on("request", (request) => requests.push(request.url()));
    await page.goto(`${host.url}examples/dom/overlay.html`);
    const loaded = () => requests.some((address) => address.endsWith("/overlay.js"));
    const hand = await mouse(page);
    const go = async () => {
      await hand.play([[0, 640, 600]]);
      await hand.rest(0.4);
      await hand.play(movement({ x: 640, y: 600 }, { x: 300, y: 250 }, 140, { seed: 1, share: 0.8 }));
    };
    await go();
    assert.equal(loaded(), false);
    const shown = () =>
      page.waitForFunction(() =>
        /Ryde/.test(document.querySelector("whither-overlay")?.shadowRoot.querySelector(".row").textContent ?? ""),
      );
    await page.click("#look");
    await go();
    await shown();
    assert.equal(loaded(), true);
    await page.evaluate(() => document.querySelector("whither-overlay").shadowRoot.querySelector("[aria-label^=Close]").click());
    const [, line] = readFileSync(join(root, "docs/overlay.md"), "utf8").match(/^(\(await import\(.*)$/m);
    await page.evaluate(line.replace("/node_modules/whither/", "/").replace(/^(.*);$/, "(async () => { $1 })()"));
    await go();
    await shown();
    assert.equal(await page.locator("whither-overlay").count(), 1);
    assert.deepEqual(errors, []);
    await page.close();
  });
});
