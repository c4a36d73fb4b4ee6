// `npm run build`: dist/, which is what the package ships.
import { copyFileSync, readdirSync, rmSync, writeFileSync } from "node:fs";
import { basename, join } from "node:path";
import { buildWasm, modules } from "./build-wasm.mjs";
import { incremental } from "./incremental.mjs";
import { Failure, main, root, run } from "./run.mjs";
import { setUp } from "./setup.mjs";

const dist = join(root, "dist");

/** What is bundled together, and the WebAssembly that it loads. */
const bundles = [
  { entries: ["index", "slim", "workerd"], module: "whither" },
  { entries: ["pointing"], module: "pointing" },
  { entries: ["pointing-workerd"], module: "pointing" },
  { entries: ["study"], module: "study" },
  { entries: ["study-workerd"], module: "study" },
];

/** Modules of their own, of which each entry takes what it needs: large ones, and the class of errors, the same for all. */
const apart = ["error", ...modules.map(({ bytes }) => `generated/${bytes}`)];

/** For resolvers that do not read `exports`: files beside package.json, where they look for `whither/slim` and the others. */
const beside = ["slim", "pointing", "study"];

/**
 * The syntax: what README promises (Chrome and Edge 94, Firefox 113, Safari 16.4, Node 20.19), and no static blocks, which Metro
 * does not read.
 */
const syntax = {
  target: ["chrome94", "edge94", "firefox113", "safari16.4", "node20.19"],
  supported: { "class-static-blocks": false },
};

export async function build() {
  await setUp();
  await buildWasm();
  const inputs = ["js", "tsconfig.json", "package.json", "package-lock.json", "scripts/build.mjs"];
  const files = ["dist/index.js", "dist/types/index.d.ts", ...modules.map(({ name }) => `dist/${name}.wasm`)];
  const outputs = [...files, ...beside.flatMap((name) => [`${name}.js`, `${name}.d.ts`])];
  await incremental("dist", { inputs, outputs, doing: "building the package, dist/" }, async () => {
    await run("node", ["node_modules/typescript/bin/tsc", "--project", "tsconfig.json"]);
    rmSync(dist, { recursive: true, force: true });
    await bundle();
    await declare();
    for (const { name } of modules) {
      copyFileSync(join(root, `js/generated/${name}_bg.wasm`), join(dist, `${name}.wasm`));
      copyFileSync(join(root, "js/entries/module.d.ts"), join(dist, `${name}.wasm.d.ts`));
    }
    for (const name of beside) {
      writeFileSync(join(root, `${name}.js`), `export * from "./dist/${name}.js";\n`);
      writeFileSync(join(root, `${name}.d.ts`), `export * from "./dist/types/${name}.js";\n`);
    }
  });
}

/** One file for each entry, one that those of `whither` share (so that the loaded engine is the same), and those apart. */
async function bundle() {
  const esbuild = await import("esbuild");
  // names stay: they are what a stack of calls is read by
  const small = { minifySyntax: true, minifyWhitespace: true, legalComments: "none", format: "esm", ...syntax };
  // An uncaught error prints the line that threw it, so lines are short; the maps lead from them to js/.
  const readable = { lineLimit: 120, sourcemap: true };
  for (const { entries, module } of bundles) {
    await esbuild.build({
      ...small,
      ...readable,
      absWorkingDir: root,
      entryPoints: entries.map((name) => `js/entries/${name}.ts`),
      outdir: "dist",
      bundle: true,
      splitting: entries.length > 1,
      chunkNames: "shared",
      define: { WASM_FILE: JSON.stringify(`${module}.wasm`) },
      plugins: [{ name: "own files", setup: (plugin) => keepApart(plugin, module) }],
    });
  }
  for (const name of apart) {
    const error = name === "error";
    const source = error ? `js/core/${name}.ts` : `js/${name}.js`;
    await esbuild.build({ ...small, ...(error ? readable : {}), absWorkingDir: root, entryPoints: [source], outdir: "dist" });
  }
  const found = readdirSync(dist).filter((name) => !name.endsWith(".map")).sort().join(" ");
  const names = [...bundles.flatMap(({ entries }) => entries), "shared", ...apart.map((name) => basename(name))];
  const expected = names.map((name) => `${name}.js`).sort().join(" ");
  if (found !== expected) throw new Failure(`dist/ must hold ${expected}, it holds ${found}`);
}

/** Leaves out what stands apart; an entry with another WebAssembly than `whither.wasm` takes the code and the bytes of its own. */
function keepApart({ onResolve }, module) {
  const own = modules.find(({ name }) => name === module);
  for (const name of apart) {
    const of = name === "generated/bytes" ? `generated/${own.bytes}` : name;
    onResolve({ filter: new RegExp(`/${name}\\.(js|ts)$`) }, () => ({ path: `./${basename(of)}.js`, external: true }));
  }
  onResolve({ filter: /\/generated\/whither\.js$/ }, () => ({ path: join(root, `js/generated/${own.name}.js`) }));
  onResolve({ filter: /^\.\/\w+\.wasm$/ }, () => ({ path: `./${own.name}.wasm`, external: true }));
}

/** The declarations, without what is not exported. */
async function declare() {
  const { rollup } = await import("rollup");
  const { dts } = await import("rollup-plugin-dts");
  const input = Object.fromEntries(["index", "slim", "pointing", "study"].map((name) => [name, `js/entries/${name}.ts`]));
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
