// What the browser tests of whither/dom share: pages that import the built package, opened in Chromium.
import { after, before } from "node:test";
import assert from "node:assert/strict";
import { join } from "node:path";
import { launch } from "../../scripts/chromium.mjs";
import { root } from "../../scripts/run.mjs";
import { serve } from "../../scripts/serve.mjs";

export { mouse, nextFrame, REST } from "../browser/support.mjs";

/** The served package and a browser, from before the first test of the group in which this is called until after its last. */
export function hosted() {
  const site = {};
  let host;
  before(async () => {
    host = await serve(join(root, "dist"));
    site.url = host.url;
    site.browser = await launch();
  });
  after(async () => {
    await site.browser?.close();
    await host?.close();
  });
  return site;
}

/**
 * Opens a page with this body. On it `whither` has the exports of `whither/dom`, and `script` (text) runs as a module after that.
 * `pages` are further addresses of the same origin, such as an iframe's: `{ "inner.html": html }`. What the page reports as an
 * error is in `problems`, and fails at `close()` unless the test has emptied the list.
 */
export async function open(site, body, { script = "", pages = {}, head = "", query = "", headers = {}, ...options } = {}) {
  const context = await site.browser.newContext({ viewport: { width: 1000, height: 700 }, ...options });
  const page = await context.newPage();
  const problems = [];
  page.on("pageerror", (error) => problems.push(`error: ${error.message}`));
  page.on("console", (message) => {
    if (["error", "warning"].includes(message.type())) problems.push(`console: ${message.text()}`);
  });
  const html = `<!doctype html><html lang="en"><head><meta charset="utf-8"><title>A page</title><link rel="icon" href="data:,">
<style>body { margin: 0 }</style>${head}</head><body>${body}
<script type="module">import * as whither from "./dom.js"; window.whither = whither;
${script}
window.isReady = true;</script></body></html>`;
  const all = { "page.html": html, ...pages };
  for (const [name, text] of Object.entries(all)) {
    const contentType = "text/html; charset=utf-8";
    await page.route(`${site.url}${name}*`, (route) => route.fulfill({ body: text, contentType, headers }));
  }
  await page.goto(`${site.url}page.html${query}`);
  await page.waitForFunction(() => window.isReady);
  return {
    page,
    problems,
    close: async () => {
      await context.close();
      assert.deepEqual(problems, []);
    },
  };
}
