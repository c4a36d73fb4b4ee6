// From src/ to js/generated/: the WebAssembly, small, its JavaScript side, and its bytes as a module.
import { readFileSync, rmSync, writeFileSync } from "node:fs";
import { homedir } from "node:os";
import { join } from "node:path";
import { gzipSync, constants } from "node:zlib";
import { incremental } from "./incremental.mjs";
import { answer, main, root, run } from "./run.mjs";
import { setUp } from "./setup.mjs";

const target = "wasm32-unknown-unknown";
const compiled = `target/${target}/wasm/whither.wasm`;
const generated = "js/generated";

/** What the engine must have, as wasm-opt names it: what rustc emits by default, and SIMD. */
const features = [
  "simd",
  "bulk-memory",
  "bulk-memory-opt",
  "call-indirect-overlong",
  "multivalue",
  "mutable-globals",
  "nontrapping-float-to-int",
  "reference-types",
  "sign-ext",
];

export async function buildWasm() {
  await compile();
  const inputs = [compiled, "Cargo.lock", "xtask", "package-lock.json", "scripts/build-wasm.mjs"];
  const outputs = ["whither.js", "whither.d.ts", "whither_bg.wasm", "bytes.js", "bytes.d.ts"];
  await incremental("wasm", { inputs, outputs: outputs.map((name) => `${generated}/${name}`) }, async () => {
    rmSync(join(root, generated), { recursive: true, force: true });
    await bindgen();
    await optimise();
    embed();
  });
}

/** These flags replace those of .cargo/config.toml. */
async function compile() {
  const sysroot = await answer("rustc", ["--print", "sysroot"]);
  const flags = [
    "-Ctarget-feature=+simd128",
    // The same file on every machine: panic messages name source files.
    `--remap-path-prefix=${process.env.CARGO_HOME ?? join(homedir(), ".cargo")}=cargo`,
    `--remap-path-prefix=${sysroot}=rust`,
    `--remap-path-prefix=${root}=`,
  ];
  const args = ["build", "--lib", "--features", "wasm", "--target", target, "--profile", "wasm", "--target-dir", "target"];
  await run("cargo", args, { env: { CARGO_ENCODED_RUSTFLAGS: flags.join("\x1f") } });
}

function bindgen() {
  const tool = ["run", "--quiet", "--package", "xtask", "--profile", "xtask", "--target-dir", "target", "--", "bindgen"];
  // The address of the file stays out of the code: bundlers would emit a second copy of it.
  const options = ["--target", "web", "--omit-default-module-path", "--remove-name-section", "--remove-producers-section"];
  return run("cargo", [...tool, ...options, "--out-dir", generated, "--out-name", "whither", compiled]);
}

async function optimise() {
  const file = `${generated}/whither_bg.wasm`;
  const tool = "node_modules/binaryen/bin/wasm-opt";
  const enabled = features.map((feature) => `--enable-${feature}`);
  await run("node", [tool, "-Oz", ...enabled, "--strip-debug", "--strip-target-features", file, "-o", file]);
}

function embed() {
  const packed = gzipSync(readFileSync(join(root, generated, "whither_bg.wasm")), { level: constants.Z_BEST_COMPRESSION });
  packed[9] = 255; // the field of the header that names the operating system
  const bytes = JSON.stringify(packed.toString("base64"));
  writeFileSync(join(root, generated, "bytes.js"), `export const base64 = ${bytes};\n`);
  writeFileSync(join(root, generated, "bytes.d.ts"), "/** whither.wasm, gzipped, in base64. */\nexport const base64: string;\n");
}

await main(import.meta.url, async () => {
  await setUp();
  await buildWasm();
});
