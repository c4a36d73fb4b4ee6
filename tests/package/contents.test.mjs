// What the package ships, and how much of it.
import { test } from "node:test";
import assert from "node:assert/strict";
import { readFileSync, readdirSync } from "node:fs";
import { homedir } from "node:os";
import { join } from "node:path";
import { gunzipSync } from "node:zlib";
import { capture, root } from "../../scripts/run.mjs";
import { sizes } from "../../scripts/size.mjs";
import { project } from "./support.mjs";

/**
 * The most gzipped bytes of an entry, WebAssembly and JavaScript; of `whither/dom` without the core, which it loads later; of those
 * beside it without that.
 */
const heaviest = {
  whither: 175_000,
  "whither/pointing": 36_000,
  "whither/dom": 8_000,
  "whither/links": 5_500,
  "whither/react": 3_000,
};

test("the package", async (t) => {
  const { folder, files } = await project(t);
  const installed = join(folder, "node_modules/whither");
  const read = (name) => readFileSync(join(installed, name));
  const metadata = JSON.parse(read("package.json"));

  await t.test("imports nothing for its effects alone, of which bundlers warn", () => {
    const scripts = files.filter((name) => name.endsWith(".js"));
    assert.deepEqual(
      scripts.filter((name) => /\bimport\s*["']/.test(read(name).toString())),
      [],
    );
  });

  await t.test("ships these files and no others, but for pages of documentation and the recipes that they link to", () => {
    const isPage = (name) => /^(docs\/[\w-]+\.md|examples\/(dom|frameworks)\/[\w/-]+\.(html|js|jsx|ts|vue|svelte))$/.test(name);
    assert.deepEqual(files.filter((name) => !isPage(name)).sort(), [
      "ARCHITECTURE.md",
      "CHANGELOG.md",
      "LICENSE-APACHE",
      "LICENSE-MIT",
      "README.md",
      "dist/bytes.js",
      "dist/dom.js",
      "dist/dom.js.map",
      "dist/error.js",
      "dist/error.js.map",
      "dist/index.js",
      "dist/index.js.map",
      "dist/keyboard.js",
      "dist/links.js",
      "dist/links.js.map",
      "dist/menu.js",
      "dist/menu.js.map",
      "dist/overlay.js",
      "dist/overlay.js.map",
      "dist/pointing-bytes.js",
      "dist/pointing-workerd.js",
      "dist/pointing-workerd.js.map",
      "dist/pointing.js",
      "dist/pointing.js.map",
      "dist/pointing.wasm",
      "dist/pointing.wasm.d.ts",
      "dist/prediction.js",
      "dist/prediction.js.map",
      "dist/react.js",
      "dist/react.js.map",
      "dist/shared.js",
      "dist/shared.js.map",
      "dist/slim.js",
      "dist/slim.js.map",
      "dist/study-bytes.js",
      "dist/study-workerd.js",
      "dist/study-workerd.js.map",
      "dist/study.js",
      "dist/study.js.map",
      "dist/study.wasm",
      "dist/study.wasm.d.ts",
      "dist/testing.js",
      "dist/testing.js.map",
      "dist/types/dom.d.ts",
      "dist/types/index.d.ts",
      "dist/types/links.d.ts",
      "dist/types/menu.d.ts",
      "dist/types/overlay.d.ts",
      "dist/types/pointing.d.ts",
      "dist/types/react.d.ts",
      "dist/types/shared.d.ts",
      "dist/types/shared2.d.ts",
      "dist/types/shared3.d.ts",
      "dist/types/shared4.d.ts",
      "dist/types/shared5.d.ts",
      "dist/types/shared6.d.ts",
      "dist/types/shared7.d.ts",
      "dist/types/shared8.d.ts",
      "dist/types/slim.d.ts",
      "dist/types/study.d.ts",
      "dist/types/testing.d.ts",
      "dist/whither.wasm",
      "dist/whither.wasm.d.ts",
      "dist/workerd.js",
      "dist/workerd.js.map",
      "docs/demo.webp",
      "docs/overlay.webp",
      "dom.d.ts",
      "dom.js",
      "links.d.ts",
      "links.js",
      "menu.d.ts",
      "menu.js",
      "overlay.d.ts",
      "overlay.js",
      "package.json",
      "pointing.d.ts",
      "pointing.js",
      "react.d.ts",
      "react.js",
      "slim.d.ts",
      "slim.js",
      "study.d.ts",
      "study.js",
      "testing.d.ts",
      "testing.js",
    ]);
  });

  await t.test("has no dependencies and runs nothing when it is installed", () => {
    assert.deepEqual(Object.keys(metadata.dependencies ?? {}), []);
    assert.deepEqual(
      readdirSync(join(folder, "node_modules")).filter((name) => !name.startsWith(".")),
      ["whither"],
    );
    for (const script of ["preinstall", "install", "postinstall"]) assert.equal(metadata.scripts[script], undefined);
  });

  await t.test("has every file that its exports name", () => {
    const named = (entry) => (typeof entry === "string" ? [entry] : Object.values(entry).flatMap(named));
    const paths = [metadata.main, metadata.types, ...Object.values(metadata.exports).flatMap(named)];
    for (const path of paths) assert.ok(files.includes(path.replace("./", "")), `${path} is missing`);
  });

  for (const [file, bytes] of Object.entries({ "whither.wasm": "bytes.js", "pointing.wasm": "pointing-bytes.js" })) {
    await t.test(`has the same ${file} inside JavaScript as in a file of its own`, async () => {
      const { base64 } = await import(join(installed, "dist", bytes));
      assert.ok(gunzipSync(Buffer.from(base64, "base64")).equals(read(`dist/${file}`)));
    });

    await t.test(`has SIMD instructions in ${file}`, async (t) => {
      const tool = join(root, "node_modules/binaryen/bin/wasm-dis");
      const { code, output } = await capture("node", [tool, "--all-features", join(installed, "dist", file)]);
      assert.equal(code, 0, output.slice(0, 1000));
      const instructions = output.match(/\b(v128|[fi](8x16|16x8|32x4|64x2))\.\w+/g)?.length ?? 0;
      t.diagnostic(`${instructions} SIMD instructions, ${output.match(/f64x2\.mul/g)?.length ?? 0} of them f64x2.mul`);
      assert.ok(instructions > 0, "no SIMD instruction: was simd128 lost?");
    });

    await t.test(`has no path of the machine that built ${file}, and none of a source file`, () => {
      const text = read(`dist/${file}`).toString("latin1");
      assert.doesNotMatch(text, /\w\.rs\b/);
      for (const path of [root, join(homedir(), ".cargo")]) assert.ok(!text.includes(path), path);
    });
  }

  await t.test("names no address of the WebAssembly, of which bundlers would make a second copy", () => {
    const names = [
      "index",
      "shared",
      "slim",
      "pointing",
      "dom",
      "links",
      "overlay",
      "menu",
      "prediction",
      "react",
      "testing",
      "study",
      "workerd",
      "pointing-workerd",
      "study-workerd",
    ];
    for (const name of names) {
      assert.doesNotMatch(read(`dist/${name}.js`).toString(), /import\.meta\.url|whither_bg\.wasm|pointing_bg\.wasm/);
    }
  });

  await t.test("carries what learns in whither/study alone", () => {
    const shipped = ["index", "shared", "slim", "workerd", "pointing", "pointing-workerd", "dom", "prediction"];
    for (const name of [...shipped, "links", "menu", "overlay", "react", "testing"]) {
      assert.doesNotMatch(read(`dist/${name}.js`).toString(), /study/, `dist/${name}.js`);
    }
    const exported = (bytes) => WebAssembly.Module.exports(new WebAssembly.Module(bytes)).map(({ name }) => name);
    assert.ok(!exported(read("dist/whither.wasm")).includes("fit"));
  });

  await t.test("has what whither/dom loads later in files of their own, and none of it inside", () => {
    const text = read("dist/dom.js").toString();
    const later = [...text.matchAll(/\bimport\("([^"]+)"\)/g)].map(([, path]) => path);
    assert.deepEqual([...new Set(later)].sort(), ["./keyboard.js", "./pointing.js", "./prediction.js"]);
    const now = [...text.matchAll(/\bfrom\s*"([^"]+)"/g)].map(([, path]) => path);
    assert.deepEqual([...new Set(now)], ["./error.js"]);
    assert.doesNotMatch(text, /extends Error|WebAssembly\./);
    assert.match(read("dist/keyboard.js").toString(), /\/\*!\s*\* tabbable [\d.]+\s*\* @license MIT/);
  });

  await t.test("is within its budget", (t) => {
    const rows = sizes(join(installed, "dist"));
    for (const { name, gzip } of rows) t.diagnostic(`${name}: ${gzip} bytes under gzip`);
    const inside = (entry) => rows.find(({ name }) => name.startsWith(`\`${entry}\``)).gzip;
    for (const [entry, most] of Object.entries(heaviest)) {
      assert.ok(inside(entry) <= most, `${entry} is ${inside(entry)} bytes under gzip`);
    }
  });
});
