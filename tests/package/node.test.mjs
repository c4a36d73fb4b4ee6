// The installed package in Node: by import and by require, with the WebAssembly from everywhere.
import { test } from "node:test";
import assert from "node:assert/strict";
import { join } from "node:path";
import { build } from "esbuild";
import { serve } from "../../scripts/serve.mjs";
import { assertPredicted, copy, inNode, project, write } from "./support.mjs";

const answer = "console.log(JSON.stringify(await predict(whither)));";
const failure = `.then(
  () => console.log(JSON.stringify({ loaded: true })),
  (error) => console.log(JSON.stringify({ whither: error instanceof WhitherError, code: error.code, message: error.message })),
);`;

test("in Node", async (t) => {
  const { folder } = await project(t);
  const slim = (source, prelude = "") =>
    inNode(
      folder,
      "slim.mjs",
      `import * as slim from "whither/slim"; import { predict } from "./predict.js"; import { readFileSync } from "node:fs";
       const bytes = readFileSync(new URL(import.meta.resolve("whither/whither.wasm"))); ${prelude}
       console.log(JSON.stringify(await predict(slim, { wasm: ${source} })));`,
    );
  const refused = (init) =>
    inNode(folder, "refused.mjs", `import { init, WhitherError } from "whither/slim"; init(${init})${failure}`);
  write(folder, "site/page.html", "<!doctype html><html><body>no such page</body></html>");
  copy(folder, "dist/whither.wasm", "site/whither.wasm");
  const server = await serve(join(folder, "site"));
  t.after(server.close);

  await t.test("import predicts", async () => {
    const text = `import * as whither from "whither"; import { predict } from "./predict.js"; ${answer}`;
    assertPredicted(await inNode(folder, "import.mjs", text));
  });

  await t.test("require predicts", async () => {
    const text = `const whither = require("whither"); const { predict } = require("./predict.js"); (async () => { ${answer} })();`;
    assertPredicted(await inNode(folder, "require.cjs", text));
  });

  for (const [kind, load] of Object.entries({ import: "await import", require: "createRequire(import.meta.url)" })) {
    await t.test(`whither/pointing by ${kind} predicts, with its bytes and with its file`, async () => {
      const text = `import { createRequire } from "node:module"; import { readFileSync } from "node:fs";
        const { init, initSync, pointerScenario, Predictor } = ${load}("whither/pointing");
        if (${kind === "import"}) await init(); else initSync({ module: readFileSync(createRequire(import.meta.url).resolve("whither/pointing.wasm")) });
        const icons = [100, 500, 900].map((x) => ({ id: String(x), x, y: 100, width: 80, height: 80 }));
        const predictor = new Predictor(pointerScenario(icons));
        for (let k = 0; k < 12; k++) predictor.observe(k / 60, [480 + k * k, 600 - 20 * k]);
        console.log(JSON.stringify(predictor.best.id));`;
      assert.equal(await inNode(folder, `pointing-${kind}.mjs`, text), "900");
    });
  }

  await t.test("an import does nothing: no request, no compilation, no unpacking", async () => {
    const text = `const touched = [];
      const watch = (object, name) => Object.defineProperty(object, name, { get: () => void touched.push(name) });
      for (const name of ["fetch", "DecompressionStream", "atob", "Response"]) watch(globalThis, name);
      for (const name of ["compile", "instantiate", "Module", "Instance"]) watch(WebAssembly, name);
      await import("whither"); await import("whither/slim"); await import("whither/pointing");
      console.log(JSON.stringify(touched));`;
    assert.deepEqual(await inNode(folder, "quiet.mjs", text), []);
  });

  await t.test("whither/slim takes bytes", async () => assertPredicted(await slim("bytes")));
  await t.test("whither/slim takes a URL", async () => assertPredicted(await slim(`new URL("${server.url}whither.wasm")`)));
  await t.test("whither/slim takes an address", async () => assertPredicted(await slim(`"${server.url}whither.wasm"`)));
  await t.test("whither/slim takes a Response", async () => assertPredicted(await slim("new Response(bytes)")));
  await t.test("whither/slim takes a promise of a Response", async () => {
    assertPredicted(await slim(`fetch("${server.url}whither.wasm")`));
  });
  await t.test("whither/slim takes a compiled module", async () => {
    assertPredicted(await slim("await WebAssembly.compile(bytes)"));
  });
  await t.test("initSync takes a compiled module", async () => {
    assertPredicted(await slim("null", "slim.initSync({ module: new WebAssembly.Module(bytes) });"));
  });

  await t.test("whither and whither/slim are one: loaded once, one class of errors", async () => {
    const text = `import { init, WhitherError } from "whither"; import * as slim from "whither/slim"; import { predict } from "./predict.js";
      await init();
      const probabilities = await predict({ init: async () => {}, Predictor: slim.Predictor });
      console.log(JSON.stringify({ probabilities, same: WhitherError === slim.WhitherError }));`;
    const { probabilities, same } = await inNode(folder, "both.mjs", text);
    assertPredicted(probabilities);
    assert.equal(same, true);
  });

  await t.test("init from an address that answers 404 says so", async () => {
    const { whither, code, message } = await refused(`{ wasm: "${server.url}missing.wasm" }`);
    assert.deepEqual([whither, code], [true, "wasm-unavailable"]);
    assert.match(message, /missing\.wasm answered with status 404/);
  });

  await t.test("init from an address that answers with a page says so", async () => {
    const { whither, code, message } = await refused(`{ wasm: "${server.url}page.html" }`);
    assert.deepEqual([whither, code], [true, "wasm-unavailable"]);
    assert.match(message, /page\.html must be WebAssembly, is an HTML page/);
  });

  await t.test("a failed init can be tried again", async () => {
    const text = `import * as slim from "whither/slim"; import { predict } from "./predict.js";
      const first = await slim.init({ wasm: "${server.url}missing.wasm" }).then(() => "loaded", (error) => error.code);
      const probabilities = await predict(slim, { wasm: "${server.url}whither.wasm" });
      console.log(JSON.stringify({ first, probabilities }));`;
    const { first, probabilities } = await inNode(folder, "again.mjs", text);
    assert.equal(first, "wasm-unavailable");
    assertPredicted(probabilities);
  });

  await t.test("the workerd build takes the module that the platform compiled", async () => {
    write(folder, "worker.js", `import * as whither from "whither"; import { predict } from "./predict.js"; ${answer}`);
    // The platform's way with an imported .wasm file: it comes as a compiled module.
    const compiled = ({ onLoad }) =>
      onLoad({ filter: /\.wasm$/ }, ({ path }) => ({
        contents: `import { readFileSync } from "node:fs"; export default new WebAssembly.Module(readFileSync(${JSON.stringify(path)}));`,
      }));
    const { outputFiles } = await build({
      absWorkingDir: folder,
      entryPoints: ["worker.js"],
      bundle: true,
      write: false,
      format: "esm",
      conditions: ["workerd"],
      external: ["node:fs"],
      plugins: [{ name: "compiled", setup: compiled }],
    });
    // Node compiles a parser of its own when Response is first named; after that, nothing may be compiled.
    const text = `void globalThis.Response; const forbid = () => { throw new Error("not allowed here"); };
      WebAssembly.compile = WebAssembly.compileStreaming = forbid;\n`;
    assertPredicted(await inNode(folder, "worker.mjs", `${text}${outputFiles[0].text}`));
  });
});
