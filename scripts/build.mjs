// `npm run build`: dist/, which is what the package ships.
import { copyFileSync, rmSync, writeFileSync } from "node:fs";
import { join } from "node:path";
import { buildWasm, modules } from "./build-wasm.mjs";
import { incremental } from "./incremental.mjs";
import { main, root, run } from "./run.mjs";
import { setUp } from "./setup.mjs";

const dist = join(root, "dist");

/** What is bundled together, and the module of WebAssembly that it loads. */
const bundles = [
  { entries: ["index", "slim", "workerd"], module: "whither" },
  { entries: ["pointing"], module: "pointing" },
  { entries: ["pointing-workerd"], module: "pointing" },
  { entries: ["study"], module: "study" },
  { entries: ["study-workerd"], module: "study" },
];

/** Entries that every page which watches waits for: a file each. Those beside `whither/dom` import that as `#dom`. */
const pages = ["dom", "react", "links", "overlay", "menu"];

/** For resolvers that do not read `exports`: files next to package.json, where they look for `whither/slim` and the others. */
const stubs = ["slim", "pointing", "study", "testing", ...pages];

/**
 * The syntax: what README promises (Chrome and Edge 94, Firefox 113, Safari 16.4, Node 20.19), and no static blocks, which Metro
 * does not read.
 */
const syntax = {
  target: ["chrome94", "edge94", "firefox113", "safari16.4", "node20.19"],
  supported: { "class-static-blocks": false },
};

/** With `dev` quickly, for trying things: neither optimised nor checked, and without declarations. */
export async function build({ dev = false } = {}) {
  await setUp();
  await buildWasm({ dev });
  const inputs = ["js", "tsconfig.json", "package.json", "package-lock.json", "scripts/build.mjs"];
  const files = ["dist/index.js", "dist/types/index.d.ts", ...modules.map(({ name }) => `dist/${name}.wasm`)];
  const outputs = [...files, ...stubs.flatMap((name) => [`${name}.js`, `${name}.d.ts`])];
  // its declarations stay as they were: those who type-check build it all
  const doing = "building the package, dist/";
  await incremental("dist", { inputs, outputs: dev ? [] : outputs, variant: dev ? " dev" : "", doing }, async () => {
    if (!dev) {
      await run("node", ["node_modules/typescript/bin/tsc", "--project", "tsconfig.json"]);
      rmSync(dist, { recursive: true, force: true });
    }
    await bundle();
    if (!dev) await declare();
    for (const { name, bytes } of modules) {
      copyFileSync(join(root, `js/generated/${bytes}.js`), join(dist, `${bytes}.js`));
      copyFileSync(join(root, `js/generated/${name}_bg.wasm`), join(dist, `${name}.wasm`));
      copyFileSync(join(root, "js/entries/module.d.ts"), join(dist, `${name}.wasm.d.ts`));
    }
    for (const name of stubs) {
      writeFileSync(join(root, `${name}.js`), `export * from "./dist/${name}.js";\n`);
      writeFileSync(join(root, `${name}.d.ts`), `export * from "./dist/types/${name}.js";\n`);
    }
  });
}

/**
 * A file for each entry, `shared.js` for what those of `whither` share (one instance), `error.js` (one class) for all, and
 * for `dom.js` the two that it loads later: `prediction.js`, and `keyboard.js`, which has another's library with its licence.
 */
async function bundle() {
  const esbuild = await import("esbuild");
  const options = {
    absWorkingDir: root,
    outdir: "dist",
    bundle: true,
    format: "esm",
    legalComments: "none",
    // names stay: they are what a stack of calls is read by
    minifySyntax: true,
    minifyWhitespace: true,
    // An uncaught error prints the line that threw it, so lines are short; the maps lead from them to js/.
    lineLimit: 120,
    sourcemap: true,
    ...syntax,
  };
  await esbuild.build({ ...options, entryPoints: ["js/core/error.ts"] });
  await esbuild.build({ ...options, entryPoints: ["js/dom/keyboard.ts"], legalComments: "inline", sourcemap: false });
  const plugins = (module) => [
    { name: "aliases", setup: ({ onResolve }) => onResolve({ filter: /^#/ }, ({ path }) => aliases(module)[path]) },
  ];
  for (const { entries, module } of bundles) {
    await esbuild.build({
      ...options,
      entryPoints: entries.map((name) => `js/entries/${name}.ts`),
      splitting: entries.length > 1,
      chunkNames: "shared",
      define: { WASM_FILE: JSON.stringify(`${module}.wasm`) },
      plugins: plugins(module),
    });
  }
  await esbuild.build({ ...options, entryPoints: ["js/entries/testing.ts"], plugins: plugins("pointing") });
  await bundleForPages();
}

/** What pages wait for, and what `dom.js` loads when a pointer moves: this bundler makes them a thirtieth smaller. */
async function bundleForPages() {
  const { rolldown } = await import("rolldown");
  const known = aliases("pointing");
  const aliasing = { name: "aliases", resolveId: (id) => known[id] && { ...known[id], id: known[id].path } };
  // not every tool takes a template literal for an address; as long as it was, so that the maps hold
  const quoting = {
    name: "quotes",
    generateBundle(_, files) {
      for (const file of Object.values(files))
        if (file.type === "chunk") file.code = file.code.replace(/\bimport\(`([^`$]+)`\)/g, 'import("$1")');
    },
  };
  // "use client" stays at the head of the file, which a test looks at
  const checks = { moduleLevelDirective: false };
  const inputs = pages.map((name) => ({ [name]: `js/entries/${name}.ts` }));
  for (const input of [...inputs, { prediction: "js/dom/prediction/prediction.ts" }]) {
    const bundle = await rolldown({
      cwd: root,
      input,
      tsconfig: false,
      external: ["react"],
      checks,
      plugins: [aliasing, quoting],
    });
    // by the names of components React's developer tools show them
    const keepNames = "react" in input;
    const minify = {
      compress: { target: syntax.target, keepNames: { function: keepNames, class: keepNames } },
      mangle: { keepNames },
      codegen: true,
    };
    await bundle.write({ dir: dist, format: "es", minify, sourcemap: true, comments: { legal: false } });
    await bundle.close();
  }
}

/**
 * Where the names with a `#` lead in an entry with this module of WebAssembly: to its generated code, and to files of their own,
 * of which `#pointing`, `#prediction` and `#keyboard` are loaded by `import()`, so that bundlers make a chunk of each.
 */
function aliases(module) {
  const { bytes } = modules.find(({ name }) => name === module);
  const file = (name) => ({ path: `./${name}`, external: true, sideEffects: false });
  return {
    "#wasm": { path: join(root, `js/generated/${module}.js`) },
    "#bytes": file(`${bytes}.js`),
    "#module": file(`${module}.wasm`),
    "#error": file("error.js"),
    "#dom": file("dom.js"),
    "#pointing": file("pointing.js"),
    "#prediction": file("prediction.js"),
    "#keyboard": file("keyboard.js"),
  };
}

/** The declarations, without what is not exported. */
async function declare() {
  const { rollup } = await import("rollup");
  const { dts } = await import("rollup-plugin-dts");
  const input = Object.fromEntries(["index", ...stubs].map((name) => [name, `js/entries/${name}.ts`]));
  const bundle = await rollup({ input, plugins: [dts({ tsconfig: join(root, "tsconfig.json") })] });
  await bundle.write({
    dir: join(dist, "types"),
    format: "es",
    entryFileNames: "[name].d.ts",
    chunkFileNames: "shared.d.ts",
    // `Symbol.dispose`, for users whose `lib` does not have it yet.
    banner: '/// <reference lib="esnext.disposable" />',
  });
  await bundle.close();
}

await main(import.meta.url, build);
