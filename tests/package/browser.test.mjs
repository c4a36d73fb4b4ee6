// The package in a browser without any bundler, and where a page forbids things.
import { test } from "node:test";
import assert from "node:assert/strict";
import { join } from "node:path";
import { launch } from "../../scripts/chromium.mjs";
import { serve } from "../../scripts/serve.mjs";
import { assertPredicted, copy, inBrowser, page, project, write } from "./support.mjs";
import { assertEager, assertFallsBack, assertWatched, program } from "./watched.mjs";

const main = `import { init, Predictor, WhitherError } from "./node_modules/whither/dist/index.js"; import { predict } from "./predict.js";
window.outcome = predict({ init, Predictor }).catch((error) => (
  { whither: error instanceof WhitherError, code: error.code, message: error.message }
));`;
const slim = (
  wasm,
) => `import { init, Predictor, WhitherError } from "./node_modules/whither/dist/slim.js"; import { predict } from "./predict.js";
window.outcome = predict({ init, Predictor }, { wasm: ${wasm} }).catch((error) => (
  { whither: error instanceof WhitherError, code: error.code, message: error.message }
));`;
const policy = (scripts) => ({ "content-security-policy": `default-src 'none'; img-src data:; script-src 'self' ${scripts}` });

test("without a bundler", async (t) => {
  const browser = await launch();
  t.after(() => browser.close());
  const { folder } = await project(t);
  write(folder, "index.html", page('<script type="module" src="./main.js"></script>'));
  write(folder, "no-such-page.html", page("no such page"));
  copy(folder, "dist/whither.wasm", "whither.wasm");
  const open = (script, options) => {
    write(folder, "main.js", script);
    return inBrowser(browser, folder, options);
  };

  await t.test("a plain module script predicts", async () => assertPredicted(await open(main)));

  await t.test("a module worker predicts", async () => {
    write(folder, "worker.js", `${main.replace("window.outcome = ", "postMessage(await ").slice(0, -1)});`);
    const asker = `window.outcome = new Promise((resolve, reject) => {
      const worker = new Worker("./worker.js", { type: "module" });
      worker.onmessage = ({ data }) => resolve(data);
      worker.onerror = reject;
    });`;
    assertPredicted(await open(asker));
  });

  await t.test("a Content-Security-Policy needs 'wasm-unsafe-eval' and nothing else", async () => {
    assertPredicted(await open(main, { headers: policy("'wasm-unsafe-eval'") }));
  });

  await t.test("without 'wasm-unsafe-eval' init rejects with an error that names it", async () => {
    // Chromium itself may report the refusal on the console.
    const outcome = await open(main, { headers: policy(""), expected: /Content Security Policy/ });
    assert.deepEqual([outcome.whither, outcome.code], [true, "wasm-unavailable"]);
    assert.match(outcome.message, /'wasm-unsafe-eval'/);
  });

  await t.test("whither/slim fetches an address", async () => assertPredicted(await open(slim('"./whither.wasm"'))));

  await t.test("an address that answers 404 is reported", async () => {
    const outcome = await open(slim('"./missing.wasm"'), { expected: /404/ });
    assert.deepEqual([outcome.whither, outcome.code], [true, "wasm-unavailable"]);
    assert.match(outcome.message, /missing\.wasm.* 404/);
  });

  await t.test("an address that answers with a page is reported", async () => {
    const outcome = await open(slim('"./no-such-page.html"'));
    assert.deepEqual([outcome.whither, outcome.code], [true, "wasm-unavailable"]);
    assert.match(outcome.message, /no-such-page\.html must be WebAssembly, is an HTML page/);
  });
});

test("whither/dom without a bundler", async (t) => {
  const browser = await launch();
  t.after(() => browser.close());
  const { folder } = await project(t);
  const served = async (t, ...options) => {
    const server = await serve(...options);
    t.after(server.close);
    return server.url;
  };

  await t.test("a page with an import map takes it from another host", async (t) => {
    const host = await served(t, join(folder, "node_modules/whither"), { headers: { "access-control-allow-origin": "*" } });
    const map = JSON.stringify({ imports: { "whither/dom": `${host}dist/dom.js` } });
    write(folder, "site/index.html", page(`<script type="importmap">${map}</script><script type="module">${program()}</script>`));
    const url = await served(t, join(folder, "site"));
    await assertWatched(browser, url);
    await assertEager(browser, url);
  });

  write(folder, "index.html", page('<script type="module" src="./main.js"></script>'));
  write(folder, "main.js", program("./node_modules/whither/dist/dom.js"));

  await t.test("a Content-Security-Policy needs 'wasm-unsafe-eval' and nothing else", async (t) => {
    await assertWatched(browser, await served(t, folder, { headers: policy("'wasm-unsafe-eval'") }));
  });

  await t.test("without 'wasm-unsafe-eval' an error names it, once, and hover, press and focus go on", async (t) => {
    const url = await served(t, folder, { headers: policy("") });
    await assertFallsBack(browser, url, { expected: /Content Security Policy/ });
  });
});
