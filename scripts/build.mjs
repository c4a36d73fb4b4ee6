// `npm run build`: dist/, which is what the package ships.
import { copyFileSync, readdirSync, rmSync } from "node:fs";
import { join } from "node:path";
import { buildWasm } from "./build-wasm.mjs";
import { incremental } from "./incremental.mjs";
import { Failure, main, root, run } from "./run.mjs";
import { setUp } from "./setup.mjs";

const dist = join(root, "dist");
const entries = ["index", "slim", "workerd"];

export async function build() {
  await setUp();
  await buildWasm();
  const inputs = ["js", "tsconfig.json", "package.json", "package-lock.json", "scripts/build.mjs"];
  const outputs = ["dist/index.js", "dist/types/index.d.ts", "dist/whither.wasm"];
  await incremental("dist", { inputs, outputs }, async () => {
    await run("node", ["node_modules/typescript/bin/tsc", "--project", "tsconfig.json"]);
    rmSync(dist, { recursive: true, force: true });
    await bundle();
    await declare();
    copyFileSync(join(root, "js/generated/whither_bg.wasm"), join(dist, "whither.wasm"));
  });
}

/**
 * One file for each entry, one that they share (so that the loaded engine and the class of errors are the same whichever
 * entry is imported), and the bytes.
 */
async function bundle() {
  const esbuild = await import("esbuild");
  await esbuild.build({
    absWorkingDir: root,
    entryPoints: entries.map((name) => `js/${name}.ts`),
    outdir: "dist",
    bundle: true,
    format: "esm",
    target: "es2022",
    splitting: true,
    chunkNames: "shared",
    minifySyntax: true,
    minifyWhitespace: true,
    legalComments: "none",
    plugins: [{ name: "own files", setup: keepApart }],
  });
  // What learns stands apart, but throws the same class of errors: it takes that from an entry without bytes.
  await esbuild.build({
    absWorkingDir: root,
    entryPoints: ["js/study.ts"],
    outdir: "dist",
    bundle: true,
    format: "esm",
    target: "es2022",
    minifySyntax: true,
    minifyWhitespace: true,
    legalComments: "none",
    plugins: [{ name: "own files", setup: keepApart }, { name: "one class of errors", setup: shareErrors }],
  });
  for (const name of ["bytes", "study-bytes"]) {
    await esbuild.build({ absWorkingDir: root, entryPoints: [`js/generated/${name}.js`], outfile: `dist/${name}.js` });
  }
  const found = readdirSync(dist).sort().join(" ");
  const expected = [...entries, "shared", "bytes", "study", "study-bytes"].map((name) => `${name}.js`).sort().join(" ");
  if (found !== expected) throw new Failure(`dist/ must hold ${expected}, it holds ${found}`);
}

function keepApart({ onResolve }) {
  for (const name of ["bytes", "study-bytes"]) {
    onResolve({ filter: new RegExp(`/generated/${name}\\.js$`) }, () => ({ path: `./${name}.js`, external: true }));
  }
  onResolve({ filter: /^\.\/whither\.wasm$/ }, () => ({ path: "./whither.wasm", external: true }));
}

function shareErrors({ onResolve }) {
  onResolve({ filter: /(^|\/)error\.(js|ts)$/ }, () => ({ path: "./slim.js", external: true }));
}

/** The declarations, without what is not exported. */
async function declare() {
  const { rollup } = await import("rollup");
  const { dts } = await import("rollup-plugin-dts");
  const input = { index: "js/index.ts", slim: "js/slim.ts", study: "js/study.ts" };
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
