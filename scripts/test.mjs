// `npm test`: all set-up and every test. `npm test -- scripts rust wasm js dom frameworks package browser` runs the parts that are named,
// `npm test -- elsewhere` one that is run only by its name.
import { readdirSync } from "node:fs";
import { join } from "node:path";
import { build } from "./build.mjs";
import { buildDemo } from "./build-demo.mjs";
import { compileTools } from "./build-wasm.mjs";
import { ensureChromium } from "./chromium.mjs";
import { countCargo, countNode, inWords, nodeArguments } from "./count.mjs";
import { capture, Failure, main, root } from "./run.mjs";
import { setUp } from "./setup.mjs";

const wasmTarget = ["--target", "wasm32-unknown-unknown"];

const parts = {
  async scripts() {
    await check("node", ["node_modules/@biomejs/biome/bin/biome", "check", "--error-on-warnings"]);
    await tests("node", nodeTests("tests/scripts"));
  },
  async rust() {
    await check("cargo", ["fmt", "--all", "--check"]);
    // with the packages that no test builds: the benchmark and what npm run evaluate and npm run reproduce start
    const packages = ["--workspace", "--exclude", "xtask"];
    await check("cargo", ["clippy", ...packages, "--all-targets", "--", "-D", "warnings"]);
    const boundary = ["--features", "wasm,wasm-fit", "--lib", "--test", "wasm"];
    await check("cargo", ["clippy", ...wasmTarget, ...boundary, "--", "-D", "warnings"]);
    const pointing = ["--features", "wasm-pointing", "--lib"];
    await check("cargo", ["clippy", ...wasmTarget, ...pointing, "--", "-D", "warnings"]);
    await check("cargo", ["doc", "--no-deps"], { RUSTDOCFLAGS: "-D warnings" });
    await tests("cargo", ["test", "--package", "whither", "--package", "whither-kernel", "--features", "whither/fit"]);
    // whose tests replay movements through the built package
    await build();
    await tests("cargo", ["test", "--package", "evaluate", "--package", "reproduce"]);
  },
  async wasm() {
    // the runner of these tests
    await compileTools();
    await tests("cargo", ["test", ...wasmTarget, "--features", "wasm", "--test", "wasm"]);
  },
  async js() {
    await build();
    await tests("node", nodeTests("tests/js"));
  },
  async dom() {
    await ensureChromium();
    await build();
    await tests("node", nodeTests("tests/dom"));
  },
  async frameworks() {
    await ensureChromium();
    await build();
    await tests("node", nodeTests("tests/frameworks"));
  },
  async package() {
    await ensureChromium();
    await build();
    await tests("node", nodeTests("tests/package"));
  },
  async browser() {
    await ensureChromium();
    await buildDemo();
    await tests("node", nodeTests("tests/browser"));
  },
};

/** What is tried with other people's large programs, which it installs first. */
const apart = {
  async elsewhere() {
    await ensureChromium();
    await build();
    await tests("node", nodeTests("tests/elsewhere"));
  },
};

/** What was run: `{ name, passed, failed, skipped, seconds }`. */
const runs = [];

/** A run that counts as one test. */
async function check(program, args, env) {
  await record(program, args, env, ({ code }) => ({ passed: Number(code === 0), failed: Number(code !== 0), skipped: 0 }));
}

/** A run of a test runner, which prints how many tests there were. */
async function tests(program, args, env) {
  await record(program, args, env, ({ code, output }) => {
    const counts = program === "cargo" ? countCargo(output) : countNode(output);
    // A runner that fails without a failed test did not get as far; one that runs no test shows nothing.
    if (counts.failed === 0 && (code !== 0 || counts.passed === 0)) counts.failed = 1;
    return counts;
  });
}

async function record(program, args, env, count) {
  const name = [program, ...args].filter((arg) => !arg.startsWith("--test-reporter")).join(" ");
  console.log(`\n> ${name}`);
  const start = Date.now();
  const counts = count(await capture(program, args, { env, show: true }));
  runs.push({ name, ...counts, seconds: Math.round((Date.now() - start) / 1000) });
}

function nodeTests(folder) {
  const files = readdirSync(join(root, folder)).filter((name) => name.endsWith(".test.mjs"));
  return nodeArguments(files.sort().map((name) => `${folder}/${name}`));
}

function summary() {
  const total = { passed: 0, failed: 0, skipped: 0 };
  console.log("");
  for (const { name, seconds, ...counts } of runs) {
    for (const key of Object.keys(total)) total[key] += counts[key];
    const shown = name.length > 76 ? `${name.slice(0, 73)}...` : name;
    console.log(`${counts.failed === 0 ? "ok    " : "FAILED"} ${shown.padEnd(76)} ${inWords(counts)} (${seconds} s)`);
  }
  console.log(`\n${inWords(total)}`);
  return total.failed === 0;
}

await main(import.meta.url, async () => {
  const wanted = process.argv.slice(2);
  const known = { ...parts, ...apart };
  const unknown = wanted.find((name) => !(name in known));
  if (unknown !== undefined) throw new Failure(`no part of the tests is named ${unknown}: ${Object.keys(known).join(", ")}`);
  await setUp();
  for (const name of wanted.length > 0 ? wanted : Object.keys(parts)) {
    try {
      await known[name]();
    } catch (error) {
      console.error(error instanceof Failure ? error.message : error);
      runs.push({ name: `what ${name} needs`, passed: 0, failed: 1, skipped: 0, seconds: 0 });
    }
  }
  if (!summary()) process.exitCode = 1;
});
