// The package in a browser without any bundler, and where a page forbids things.
import { test } from "node:test";
import assert from "node:assert/strict";
import { launch } from "../../scripts/chromium.mjs";
import { assertPredicted, copy, inBrowser, page, project, write } from "./support.mjs";

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
