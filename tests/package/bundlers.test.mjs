// Pages of users who know nothing of WebAssembly: each bundler as it comes, the result opened in the browser.
import { test } from "node:test";
import assert from "node:assert/strict";
import { basename, join } from "node:path";
import { promisify } from "node:util";
import * as esbuild from "esbuild";
import { nodeResolve } from "@rollup/plugin-node-resolve";
import { rollup } from "rollup";
import * as vite from "vite";
import webpack from "webpack";
import { launch } from "../../scripts/chromium.mjs";
import { serve } from "../../scripts/serve.mjs";
import { assertPredicted, inBrowser, inTab, page, project, write } from "./support.mjs";
import { assertEager, assertWatched, program as watchingLinks } from "./watched.mjs";

const program = `import { init, Predictor } from "whither"; import { predict } from "./predict.js";
window.outcome = predict({ init, Predictor });`;

/** Each takes a project with `main.js` and makes `site/main.js`. */
const bundlers = {
  async esbuild(folder) {
    await esbuild.build({ absWorkingDir: folder, entryPoints: ["main.js"], bundle: true, outdir: "site", logLevel: "warning" });
  },
  async "esbuild, split and minified"(folder) {
    const options = { bundle: true, minify: true, splitting: true, format: "esm" };
    await esbuild.build({ absWorkingDir: folder, entryPoints: ["main.js"], ...options, outdir: "site", logLevel: "warning" });
  },
  async Rollup(folder) {
    const bundle = await rollup({ input: join(folder, "main.js"), plugins: [nodeResolve()] });
    await bundle.write({ dir: join(folder, "site"), format: "es" });
    await bundle.close();
  },
  async webpack(folder) {
    const configuration = { context: folder, mode: "production", entry: "./main.js", output: { path: join(folder, "site") } };
    const result = await promisify(webpack)(configuration);
    if (result.hasErrors()) throw new Error(result.toString());
  },
  async Vite(folder) {
    write(folder, "index.html", page('<script type="module" src="./main.js"></script>'));
    const build = { outDir: "site", emptyOutDir: true };
    await vite.build({ root: folder, configFile: false, logLevel: "warn", build });
  },
};

/** What makes one file of all, so that nothing can come later. */
const inOneFile = (name) => name === "esbuild";

test("bundled without configuration", async (t) => {
  const browser = await launch();
  t.after(() => browser.close());
  const { folder } = await project(t);
  write(folder, "main.js", program);
  for (const [name, bundle] of Object.entries(bundlers)) {
    await t.test(`by ${name}`, async () => {
      write(folder, "site/index.html", page('<script type="module" src="./main.js"></script>'));
      await bundle(folder);
      assertPredicted(await inBrowser(browser, join(folder, "site")));
    });
  }

  await t.test("whither/pointing alone brings its own WebAssembly and no other", async () => {
    write(
      folder,
      "pointer.js",
      'import { init, PointerPredictor } from "whither/pointing"; window.outcome = init().then(() => PointerPredictor);',
    );
    const options = { bundle: true, minify: true, format: "esm", outdir: "site", metafile: true };
    const { metafile } = await esbuild.build({ absWorkingDir: folder, entryPoints: ["pointer.js"], ...options });
    const files = Object.keys(metafile.inputs)
      .filter((name) => name.includes("whither/dist/"))
      .map((name) => basename(name));
    assert.deepEqual(files.sort(), ["error.js", "pointing-bytes.js", "pointing.js"]);
  });

  await t.test("by Vite's development server", async (t) => {
    const url = await developmentServer(t, folder);
    const outcome = async (tab) => {
      await tab.goto(url);
      return tab.evaluate(() => window.outcome);
    };
    assertPredicted(await inTab(browser, outcome));
  });
});

test("whither/dom bundled without configuration: the core is a file of its own that comes later", async (t) => {
  const browser = await launch();
  t.after(() => browser.close());
  const { folder } = await project(t);
  write(folder, "main.js", watchingLinks());
  for (const [name, bundle] of Object.entries(bundlers)) {
    await t.test(`by ${name}`, async (t) => {
      write(folder, "site/index.html", page('<script type="module" src="./main.js"></script>'));
      await bundle(folder);
      const server = await serve(join(folder, "site"));
      t.after(server.close);
      await assertWatched(browser, server.url, { inOneFile: inOneFile(name) });
      await assertEager(browser, server.url);
    });
  }

  await t.test("by Vite's development server", async (t) => {
    const url = await developmentServer(t, folder);
    await assertWatched(browser, url);
    await assertEager(browser, url);
  });
});

async function developmentServer(t, folder) {
  const server = await vite.createServer({ root: folder, configFile: false, logLevel: "warn", server: { port: 0 } });
  t.after(() => server.close());
  await server.listen();
  return `http://localhost:${server.httpServer.address().port}/`;
}
