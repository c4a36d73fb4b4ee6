// Who resolves the package's names: TypeScript in each of its ways, bundlers that do not read `exports`, the checks of both.
import { test } from "node:test";
import assert from "node:assert/strict";
import { readFileSync } from "node:fs";
import { join } from "node:path";
import { promisify } from "node:util";
import { checkPackage, createPackageFromTarballData } from "@arethetypeswrong/core";
import { publint } from "publint";
import { formatMessage } from "publint/utils";
import webpack from "webpack";
import { launch } from "../../scripts/chromium.mjs";
import { inBrowser, page, project, write } from "./support.mjs";

/**
 * Whom attw finds to be missing something that we do not offer: the package is ES modules, which CommonJS has by `require` since
 * Node 20.19, and a resolver that does not read `exports` finds the WebAssembly under `whither/dist/`.
 */
function unavoidable({ kind, entrypoint, resolutionKind }) {
  if (kind === "CJSResolvesToESM") return true;
  return kind === "NoResolution" && resolutionKind === "node10" && entrypoint.endsWith(".wasm");
}

test("the package's names", async (t) => {
  const { folder, tarball } = await project(t);

  await t.test("are typed for every resolver of TypeScript (attw)", async () => {
    const { entrypoints, problems } = await checkPackage(createPackageFromTarballData(readFileSync(tarball)));
    const names = [
      ".",
      "./slim",
      "./pointing",
      "./dom",
      "./react",
      "./testing",
      "./links",
      "./overlay",
      "./menu",
      "./study",
      "./whither.wasm",
      "./pointing.wasm",
      "./package.json",
    ];
    assert.deepEqual(Object.keys(entrypoints), names);
    assert.deepEqual(
      problems.filter((problem) => !unavoidable(problem)),
      [],
    );
  });

  await t.test("are sound (publint)", async () => {
    const { messages, pkg } = await publint({ pkgDir: join(folder, "node_modules/whither"), pack: false, strict: true });
    assert.deepEqual(
      messages.map((message) => formatMessage(message, pkg)),
      [],
    );
  });

  await t.test("are found without exports, and all that they name predicts", async () => {
    const text = `import { init, Predictor, pointerScenario } from "whither";
      import * as slim from "whither/slim"; import * as pointing from "whither/pointing"; import { watch } from "whither/dom";
      import { fit } from "whither/study"; import { hand } from "whither/testing";
      import { links } from "whither/links";
      const icons = [100, 500, 900].map((x) => ({ id: String(x), x, y: 100, width: 80, height: 80 }));
      const best = ({ Predictor, pointerScenario, PointerPredictor }) => {
        const predictor = PointerPredictor ? new PointerPredictor(icons) : new Predictor(pointerScenario(icons));
        for (let k = 0; k < 12; k++) predictor.observe(k / 60, [480 + k * k, 600 - 20 * k]);
        return predictor.best.id;
      };
      window.outcome = Promise.all([init(), pointing.init()]).then(async () => [
        ...[{ Predictor, pointerScenario }, slim, pointing].map(best),
        await fit([], {}).catch(({ code }) => code),
        await watch("a", { load: "eager" }).ready.then(() => "watched"),
        hand({ x: 0, y: 0 }, { x: 9, y: 9 }).length > 1,
        await links({ load: "eager" }).watcher.ready.then(() => "ahead"),
      ]);`;
    write(folder, "main.js", text);
    write(folder, "site/index.html", page('<script type="module" src="./main.js"></script>'));
    const configuration = {
      context: folder,
      mode: "production",
      entry: "./main.js",
      output: { path: join(folder, "site") },
      resolve: { exportsFields: [] },
      module: { rules: [{ resolve: { fullySpecified: false } }] },
    };
    const result = await promisify(webpack)(configuration);
    assert.ok(!result.hasErrors(), result.toString());
    const browser = await launch();
    t.after(() => browser.close());
    assert.deepEqual(await inBrowser(browser, join(folder, "site")), [
      "900",
      "900",
      "900",
      "out-of-range",
      "watched",
      true,
      "ahead",
    ]);
  });
});
