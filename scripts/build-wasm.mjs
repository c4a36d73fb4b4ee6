// From src/ to js/generated/: the WebAssembly, small, its JavaScript side, and its bytes as a module; once for all that
// predicts, once for the pointing model alone and once for what learns.
import { copyFileSync, mkdirSync, readFileSync, rmSync, writeFileSync } from "node:fs";
import { homedir } from "node:os";
import { join } from "node:path";
import { gzipSync } from "node:zlib";
import { compile } from "./cargo.mjs";
import { incremental } from "./incremental.mjs";
import { answer, main, root, run } from "./run.mjs";
import { setUp } from "./setup.mjs";
import { during } from "./stage.mjs";
import { trapPanics } from "./traps.mjs";

const target = "wasm32-unknown-unknown";
const generated = "js/generated";

/** Each module: its name, the features and the profile that make it, and the name of its bytes. */
export const modules = [
  { name: "whither", features: ["wasm"], profile: "wasm", bytes: "bytes" },
  { name: "pointing", features: ["wasm-pointing"], profile: "wasm-pointing", bytes: "pointing-bytes" },
  { name: "study", features: ["wasm-fit"], profile: "wasm", bytes: "study-bytes" },
];

/** What the engine must have, as wasm-opt names it: what rustc emits by default, and SIMD. */
const instructions = [
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

/** With `dev` quickly, for trying things: hardly optimised by the compiler, not at all by wasm-opt. */
export async function buildWasm({ dev = false } = {}) {
  const variant = dev ? " dev" : "";
  const compiled = modules.map(({ name }) => `target/wasm/${name}.wasm`);
  // Cargo by itself would compile all at every call, since they have the same output path.
  const sources = ["src", "kernel", "Cargo.toml", "Cargo.lock", "rust-toolchain.toml", "scripts/build-wasm.mjs"];
  await incremental("wasm-modules", { inputs: sources, outputs: compiled, variant, doing: null }, async () => {
    for (const [i, module] of modules.entries()) await toWasm(module, compiled[i], dev ? "wasm-dev" : module.profile);
  });
  const inputs = [...compiled, "Cargo.lock", "tools/xtask", "package-lock.json", "scripts/build-wasm.mjs", "scripts/traps.mjs"];
  const outputs = modules.flatMap(({ name, bytes }) => [
    `${name}.js`,
    `${name}.d.ts`,
    `${name}_bg.wasm`,
    `${bytes}.js`,
    `${bytes}.d.ts`,
  ]);
  await incremental(
    "wasm",
    { inputs, outputs: outputs.map((name) => `${generated}/${name}`), variant, doing: null },
    async () => {
      rmSync(join(root, generated), { recursive: true, force: true });
      await compileTools();
      for (const [i, { name }] of modules.entries()) await bindgen(compiled[i], name);
      const packed = ({ name }) => (dev ? gzipSync(readFileSync(join(root, `${generated}/${name}_bg.wasm`))) : small(name));
      // wasm-opt has one thread
      await during("making the modules small", () =>
        Promise.all(modules.map(async (module) => embed(module.name, module.bytes, await packed(module)))),
      );
    },
  );
}

/** These flags replace those of .cargo/config.toml. */
async function toWasm({ name, features }, file, profile) {
  const sysroot = await answer("rustc", ["--print", "sysroot"]);
  const flags = [
    "-Ctarget-feature=+simd128",
    // Loops of known length in the kernel, at level 2; at the level for size none is unrolled.
    "-Cllvm-args=-unroll-threshold=220",
    // The same file on every machine: panic messages name source files.
    `--remap-path-prefix=${process.env.CARGO_HOME ?? join(homedir(), ".cargo")}=cargo`,
    `--remap-path-prefix=${sysroot}=rust`,
    `--remap-path-prefix=${root}=`,
  ];
  const parts = ["--features", features.join()];
  // A `cdylib` alone: made together with an `rlib` the file keeps all that other crates could call, an eighth of it.
  const kind = ["--lib", "--crate-type", "cdylib"];
  const args = ["rustc", ...kind, ...parts, "--target", target, "--profile", profile, "--target-dir", "target"];
  await compile(`compiling ${name} to WebAssembly`, args, { env: { CARGO_ENCODED_RUSTFLAGS: flags.join("\x1f") } });
  mkdirSync(join(root, file, ".."), { recursive: true });
  copyFileSync(join(root, `target/${target}/${profile}/whither.wasm`), join(root, file));
}

const tools = ["--package", "xtask", "--profile", "xtask", "--target-dir", "target"];

/** The tools of tools/xtask, wasm-bindgen among them, which take minutes the first time. */
export const compileTools = () => compile("compiling the tools for WebAssembly, once", ["build", ...tools]);

function xtask(...args) {
  return run("cargo", ["run", "--quiet", ...tools, "--", ...args]);
}

/** The classes that call WebAssembly and the functions that it calls. `js/core/loading/instantiate.ts` joins both. */
async function bindgen(compiled, name) {
  const options = ["--target", "bundler", "--remove-producers-section"];
  await xtask("bindgen", ...options, "--out-dir", generated, "--out-name", name, compiled);
  const file = (end) => join(root, generated, `${name}${end}`);
  // What it would make when it is imported, `js/core/loading/platform.ts` makes at its first use.
  const lazy = 'import { FinalizationRegistry, TextDecoder, TextEncoder } from "../core/loading/platform.ts";\n';
  // What `src/wasm/` calls by name.
  const named = 'import { WhitherError } from "#error";\nimport { best } from "../core/best.ts";\n';
  const code = readFileSync(file("_bg.js"), "utf8").replace(/^export (?=function __wb(?!g_set_wasm\b))/gm, "");
  const called = WebAssembly.Module.imports(new WebAssembly.Module(readFileSync(file("_bg.wasm"))));
  const names = called.map(({ name }) => name).join(", ");
  const imports = `export function imports() {\n  return { "${called[0].module}": { ${names} } };\n}\n`;
  writeFileSync(file(".js"), `${lazy}${named}${code}\n${imports}`);
  const declared = "export function __wbg_set_wasm(exports: object): void;\nexport function imports(): WebAssembly.Imports;\n";
  writeFileSync(file(".d.ts"), `${readFileSync(file(".d.ts"), "utf8")}\n${declared}`);
  rmSync(file("_bg.js"));
}

/** Makes the file small, and gives what it is under gzip. */
async function small(name) {
  const file = `${generated}/${name}_bg.wasm`;
  await trapPanics(join(root, file));
  const tool = "node_modules/binaryen/bin/wasm-opt";
  const enabled = instructions.map((set) => `--enable-${set}`);
  // Large functions with a single caller stay functions: inlined they compress worse, by 6%.
  const size = ["-Oz", "-Oz", "--one-caller-inline-max-function-size=10"];
  // Nothing is read below address 1024, the end of the stack: what is added to an address can be part of the instruction.
  size.push("--low-memory-unused");
  // These two passes remove what compresses well: without them there is half a percent less under gzip.
  size.push("--skip-pass=local-cse", "--skip-pass=merge-locals");
  await run("node", [tool, ...size, ...enabled, "--strip-debug", "--strip-target-features", file, "-o", file]);
  await xtask("gzip", file, `target/wasm/${name}.wasm.gz`);
  return readFileSync(join(root, `target/wasm/${name}.wasm.gz`));
}

/** Writes the module of the packed bytes. */
function embed(name, bytes, packed) {
  packed[9] = 255; // the field of the header that names the operating system
  const base64 = JSON.stringify(packed.toString("base64"));
  writeFileSync(join(root, generated, `${bytes}.js`), `export const base64 = ${base64};\n`);
  const declaration = `/** ${name}.wasm, gzipped, in base64. */\nexport const base64: string;\n`;
  writeFileSync(join(root, generated, `${bytes}.d.ts`), declaration);
}

await main(import.meta.url, async () => {
  await setUp();
  await buildWasm();
});
