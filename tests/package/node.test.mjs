// The installed package in Node: by import and by require, with the WebAssembly from everywhere.
import { test } from "node:test";
import assert from "node:assert/strict";
import { join } from "node:path";
import { build } from "esbuild";
import { capture } from "../../scripts/run.mjs";
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
        const { init, initSync, PointerPredictor } = ${load}("whither/pointing");
        if (${kind === "import"}) await init(); else initSync({ module: readFileSync(createRequire(import.meta.url).resolve("whither/pointing.wasm")) });
        const icons = [100, 500, 900].map((x) => ({ id: String(x), x, y: 100, width: 80, height: 80 }));
        const predictor = new PointerPredictor(icons);
        for (let k = 0; k < 12; k++) predictor.observe(k / 60, [480 + k * k, 600 - 20 * k]);
        console.log(JSON.stringify(predictor.best.id));`;
      assert.equal(await inNode(folder, `pointing-${kind}.mjs`, text), "900");
    });
  }

  for (const [kind, load] of Object.entries({ import: "await import", require: "createRequire(import.meta.url)" })) {
    await t.test(`whither/dom by ${kind}: watch() does nothing on a server, and what it returns is at rest`, async () => {
      const text = `import { createRequire } from "node:module";
        const { watch, WhitherError } = ${load}("whither/dom");
        const called = [];
        const callback = (name) => () => void called.push(name);
        const options = { load: "eager", record: true, reasons: { keyboard: { tabs: 2 } } };
        for (const name of ["onIntent", "onRelease", "onPrediction", "onOutcome", "onError"]) options[name] = callback(name);
        const watcher = watch("nav a, [data-card]", options);
        const shape = { id: "shape", bounds: () => ({ x: 0, y: 0, width: 9, height: 9 }) };
        const other = watch([shape]);
        other.add({ ...shape, id: "another" });
        other.set(shape, { prior: 2 });
        other.remove(shape);
        watcher.update({ threshold: 0.9 });
        const unsubscribe = watcher.subscribe(callback("listener"));
        const first = watcher.getSnapshot();
        watcher.refresh();
        watcher.pause();
        watcher.resume();
        await new Promise((resolve) => setTimeout(resolve, 50));
        const { best, none, remaining, targets, ledger } = watcher;
        const read = { best, none, remaining, targets, snapshot: first, same: watcher.getSnapshot() === first };
        const asked = [watcher.probability(shape), watcher.forecast(1), watcher.path(shape, [1]).length];
        const outcomes = [ledger.summary(), ledger.outcomes, ledger.lines()];
        unsubscribe();
        watcher.stop();
        other.stop();
        console.log(JSON.stringify({ called, read, asked, outcomes, error: typeof WhitherError }));`;
      assert.deepEqual(await inNode(folder, `dom-${kind}.mjs`, text), {
        called: [],
        read: {
          best: null,
          none: 1,
          remaining: null,
          targets: [],
          snapshot: { moving: false, best: null, none: 1, targets: [], intended: [] },
          same: true,
        },
        asked: [0, null, 0],
        outcomes: [null, [], []],
        error: "function",
      });
    });
  }

  await t.test("whither/links: links() does nothing on a server", async () => {
    const text = `import { links } from "whither/links";
      const ahead = links({ selector: "nav a", ignore: /admin/ });
      const { requested, lead } = ahead.stats();
      ahead.stop();
      console.log(JSON.stringify([requested, lead, ahead.excluded({}), ahead.watcher.none]));`;
    assert.deepEqual(await inNode(folder, "links.mjs", text), [0, null, null, 1]);
  });

  await t.test("an import does nothing: no request, no compilation, nothing of the platform is used or made", async () => {
    // The language itself may be used: classes are made, and an error is one that extends another.
    const language = [
      "Object",
      "Function",
      "Array",
      "String",
      "Symbol",
      "Error",
      "Promise",
      "Reflect",
      "globalThis",
      "undefined",
    ];
    const text = `const touched = [];
      const names = Object.getOwnPropertyNames(globalThis).filter((name) => !${JSON.stringify(language)}.includes(name));
      const present = new Map(names.map((name) => [name, Object.getOwnPropertyDescriptor(globalThis, name)]));
      const watch = (object, name) => Object.defineProperty(object, name, { configurable: true, get: () => void touched.push(name) });
      for (const name of ["compile", "instantiate", "Module", "Instance"]) watch(WebAssembly, name);
      for (const [name, { configurable }] of present) if (configurable) watch(globalThis, name);
      // what Node's own loader reads of the global object while it loads
      await import("./nothing.mjs");
      const node = touched.splice(0);
      const entries = ["", "/slim", "/pointing", "/dom", "/links", "/menu", "/overlay", "/testing", "/study"];
      for (const entry of entries) await import("whither" + entry);
      for (const [name, descriptor] of present) if (descriptor.configurable) Object.defineProperty(globalThis, name, descriptor);
      console.log(JSON.stringify({ watched: present.size, touched: touched.filter((name) => !node.includes(name)) }));`;
    write(folder, "nothing.mjs", "export {};");
    const { watched, touched } = await inNode(folder, "quiet.mjs", text);
    assert.deepEqual(touched, []);
    assert.ok(watched > 100, `${watched} globals were watched`);
  });

  await t.test("without WebAssembly every way to load rejects, and the process goes on", async () => {
    const text = `const reported = [];
      const report = (error) => reported.push([error?.name, error?.code, error?.message].join());
      for (const entry of ["whither", "whither/slim", "whither/pointing"]) {
        const { init, initSync } = await import(entry);
        await init().catch(report);
        await init({ wasm: "http://localhost:1/whither.wasm" }).catch(report);
        await init({ wasm: new Uint8Array(8) }).catch(report);
        try { initSync({ module: new Uint8Array(8) }); } catch (error) { report(error); }
      }
      const { fit } = await import("whither/study");
      await fit([], {}).catch(report);
      console.log(JSON.stringify(reported));`;
    write(folder, "jitless.mjs", text);
    const { code, output } = await capture("node", ["--jitless", "jitless.mjs"], { cwd: folder });
    assert.equal(code, 0, output);
    const reported = JSON.parse(output.trim().split("\n").at(-1)); // V8 warns of the flag
    const expected = "WhitherError,wasm-unavailable,WebAssembly does not exist here";
    assert.deepEqual(
      reported,
      Array.from({ length: 13 }, () => expected),
    );
  });

  await t.test("an uncaught error prints a few lines, and with source maps the place in js/", async () => {
    const uses = {
      "by Rust": "await init(); new Predictor({ motion: 1 });",
      "by TypeScript": "await init(); new Predictor(() => 1);",
      "before init": "new Predictor({});",
      "by a promise": "init(5);",
      "by another":
        'await init(); const p = new Predictor(pointerScenario([{ id: "a", x: 0, y: 0, width: 1, height: 1 }])); p.free(); p.free();',
    };
    for (const entry of ["whither", "whither/pointing", "whither/slim"]) {
      for (const [what, use] of Object.entries(uses)) {
        const wasm =
          entry === "whither/slim"
            ? use.replace("init()", 'init({ wasm: (await import("node:fs")).readFileSync("site/whither.wasm") })')
            : use;
        // whatever a PointerPredictor is given, it refuses or frees alike
        const names = entry === "whither/pointing" ? "PointerPredictor as Predictor" : "Predictor, pointerScenario";
        const pointer = entry === "whither/pointing" ? "const pointerScenario = (targets) => targets;" : "";
        write(folder, "uncaught.mjs", `import { init, ${names} } from "${entry}"; ${pointer} ${wasm}`);
        for (const flags of [[], ["--enable-source-maps"]]) {
          const { code, output } = await capture("node", [...flags, "uncaught.mjs"], { cwd: folder });
          assert.equal(code, 1);
          assert.match(output, /WhitherError: /, output.slice(0, 400));
          const lines = output.split("\n");
          const longest = Math.max(...lines.map((line) => line.length));
          assert.ok(lines.length < 32 && longest < 600, `${entry} ${what}: ${lines.length} lines, the longest of ${longest}`);
          if (flags.length > 0) assert.match(output, /js\/[\w/-]+\.ts:\d+/, `${entry} ${what}`);
        }
      }
    }
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

  await t.test("init from an address that answers 404 reports it", async () => {
    const { whither, code, message } = await refused(`{ wasm: "${server.url}missing.wasm" }`);
    assert.deepEqual([whither, code], [true, "wasm-unavailable"]);
    assert.match(message, /missing\.wasm answered with status 404/);
  });

  await t.test("init from an address that answers with a page reports it", async () => {
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

  await t.test("where code may not compile, each entry takes the module that the platform compiled", async () => {
    const programs = {
      whither: `import * as whither from "whither"; import { predict } from "./predict.js"; ${answer}`,
      "whither/pointing": `import { init, PointerPredictor } from "whither/pointing"; await init();
        const predictor = new PointerPredictor([{ id: "a", x: 0, y: 0, width: 9, height: 9 }]);
        predictor.observe(0, [9, 9]); console.log(JSON.stringify(predictor.best.id));`,
      "whither/study": `import { fit } from "whither/study"; console.log(JSON.stringify(await fit([], {}).catch(({ code }) => code)));`,
      "whither/slim": `import * as slim from "whither/slim"; import wasm from "whither/whither.wasm"; import { predict } from "./predict.js";
        console.log(JSON.stringify(await predict(slim, { wasm })));`,
    };
    const expected = { "whither/pointing": "a", "whither/study": "out-of-range" };
    // The platform's way with an imported .wasm file: it comes as a compiled module.
    const compiled = ({ onLoad }) =>
      onLoad({ filter: /\.wasm$/ }, ({ path }) => ({
        contents: `import { readFileSync } from "node:fs"; export default new WebAssembly.Module(readFileSync(${JSON.stringify(path)}));`,
      }));
    for (const [entry, program] of Object.entries(programs)) {
      write(folder, "worker.js", program);
      const { outputFiles, metafile } = await build({
        absWorkingDir: folder,
        entryPoints: ["worker.js"],
        bundle: true,
        write: false,
        metafile: true,
        format: "esm",
        conditions: ["workerd"],
        external: ["node:fs"],
        plugins: [{ name: "compiled", setup: compiled }],
      });
      assert.deepEqual(
        Object.keys(metafile.inputs).filter((name) => name.includes("bytes")),
        [],
        `${entry} brings no bytes`,
      );
      // Node compiles a parser of its own when Response is first named; after that, nothing may be compiled.
      const text = `void globalThis.Response; const forbid = () => { throw new Error("not allowed here"); };
        WebAssembly.compile = WebAssembly.compileStreaming = forbid;\n`;
      const outcome = await inNode(folder, "worker.mjs", `${text}${outputFiles[0].text}`);
      if (entry in expected) assert.equal(outcome, expected[entry]);
      else assertPredicted(outcome);
    }
  });
});
