// What a machine needs besides Rust and Node.
import { existsSync, readFileSync } from "node:fs";
import { join } from "node:path";
import { incremental } from "./incremental.mjs";
import { answer, environment, Failure, root, run } from "./run.mjs";

/** Makes sure of everything that a build needs. */
export async function setUp() {
  checkNode();
  await ensureRust();
  await ensurePackages();
}

function checkNode() {
  const [major, minor] = process.versions.node.split(".").map(Number);
  if (major > 20 || (major === 20 && minor >= 19)) return;
  throw new Failure(`Node ${process.versions.node} is too old: install Node 20.19 or newer (https://nodejs.org)`);
}

async function ensureRust() {
  const viaRustup = (await answer("rustup", ["--version"])) !== null;
  if (viaRustup && (await answer("rustc", ["--version"])) === null) {
    // the pinned version may be there already under the name "stable": nothing to download
    const [, pinned] = readFileSync(join(root, "rust-toolchain.toml"), "utf8").match(/channel = "(.*)"/);
    if ((await answer("rustc", ["+stable", "--version"]))?.startsWith(`rustc ${pinned} `))
      environment.RUSTUP_TOOLCHAIN = "stable";
    else await run("rustup", ["toolchain", "install"]);
  }
  if ((await answer("cargo", ["--version"])) === null) {
    throw new Failure("Rust is missing: install it from https://rustup.rs, open a new terminal and try again");
  }
  const target = "wasm32-unknown-unknown";
  const sysroot = await answer("rustc", ["--print", "sysroot"]);
  if (sysroot !== null && existsSync(join(sysroot, "lib/rustlib", target))) return;
  if (!viaRustup) {
    throw new Failure(`this Rust has no standard library for ${target}: install that package, or Rust from https://rustup.rs`);
  }
  await run("rustup", ["target", "add", target]);
}

async function ensurePackages() {
  const doing = "installing the packages that package-lock.json names";
  const places = { inputs: ["package-lock.json"], outputs: ["node_modules/.package-lock.json"], doing };
  await incremental("node_modules", places, () =>
    run("npm", ["ci", "--no-audit", "--no-fund", "--loglevel=error"], { cwd: root }),
  );
}
