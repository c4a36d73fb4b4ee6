// What is printed while something is done: that it has begun, how far it is, and nothing where there is nothing to do.
import { test } from "node:test";
import assert from "node:assert/strict";
import { mkdirSync, mkdtempSync, rmSync, writeFileSync } from "node:fs";
import { tmpdir } from "node:os";
import { join } from "node:path";
import { capture, root } from "../../scripts/run.mjs";

const script = (name) => new URL(`../../scripts/${name}`, import.meta.url).href;

/** Runs a module, its output no terminal. */
const run = (text, options) => capture("node", ["--input-type=module", "--eval", text], options);

/** A crate that takes two seconds to build, long enough for them to be counted, and one that it needs. */
function slow(t, source = "fn main() {}") {
  const folder = mkdtempSync(join(tmpdir(), "whither-stage-"));
  t.after(() => rmSync(folder, { recursive: true, force: true }));
  const files = {
    "Cargo.toml": '[package]\nname = "slow"\nedition = "2024"\n[dependencies]\nneeded = { path = "needed" }\n[workspace]\n',
    "src/main.rs": source,
    "needed/Cargo.toml": '[package]\nname = "needed"\nedition = "2024"\n',
    "needed/src/lib.rs": "",
    "needed/build.rs": "fn main() { std::thread::sleep(std::time::Duration::from_secs(2)); }",
  };
  for (const [name, text] of Object.entries(files)) {
    mkdirSync(join(folder, name, ".."), { recursive: true });
    writeFileSync(join(folder, name), text);
  }
  return folder;
}

const compiling = (folder) => `
  process.stderr.isTTY = SHOWN;
  const { compile } = await import(${JSON.stringify(script("cargo.mjs"))});
  await compile("compiling what is slow", ["build", "--offline"], { cwd: ${JSON.stringify(folder)} });`;

test("compilation is reported and counted on a terminal; without it nothing is printed", async (t) => {
  const folder = slow(t);
  const first = await run(compiling(folder).replace("SHOWN", "true"));
  assert.equal(first.code, 0, first.output);
  assert.match(first.output, /^> compiling what is slow\r> compiling what is slow: .*\d of [45] compiled, \d s/);
  assert.match(first.output, /\r> compiling what is slow: \d+ s\x1b\[K\n$/);
  const second = await run(compiling(folder).replace("SHOWN", "true"));
  assert.deepEqual(second, { code: 0, output: "" });
});

test("where there is no terminal one line reports what begins; warnings are shown", async (t) => {
  const { code, output } = await run(compiling(slow(t, "fn main() {}\nfn unused() {}")).replace("SHOWN", "false"));
  assert.equal(code, 0, output);
  assert.match(output, /^> compiling what is slow\nwarning: function `unused` is never used/);
  assert.doesNotMatch(output, /\r|Compiling|Finished/);
});

test("an error of the compiler is shown, and fails", async (t) => {
  const { code, output } = await run(compiling(slow(t, "fn main() { wrong }")).replace("SHOWN", "false"));
  assert.equal(code, 1);
  assert.match(output, /error\[E0425\]: cannot find value `wrong`/);
  assert.match(output, /cargo build --offline failed \(exit code 101\)/);
});

test("where there is no terminal a long stage is reported again every ten seconds, and at its end", async () => {
  const { output } = await run(
    `
    import { mock } from "node:test";
    const { stage } = await import(${JSON.stringify(script("stage.mjs"))});
    mock.timers.enable({ apis: ["setInterval", "Date"] });
    const running = stage("something long");
    running.more("1 of 2");
    for (let second = 0; second < 11; second++) mock.timers.tick(1000);
    running.end();`,
    { env: { NODE_NO_WARNINGS: "1" } },
  );
  assert.equal(output, "> something long\n> something long: 1 of 2, 10 s\n> something long: done in 11 s\n");
});

test("work that is done only once is reported when it is done, and not again", async (t) => {
  const name = `stage-test-${process.pid}`;
  t.after(() => rmSync(join(root, "target/stamps", name), { force: true }));
  const text = `
    const { incremental } = await import(${JSON.stringify(script("incremental.mjs"))});
    await incremental(${JSON.stringify(name)}, { inputs: ["package.json"], outputs: ["package.json"], doing: "doing it" }, async () => {});`;
  assert.deepEqual([(await run(text)).output, (await run(text)).output], ["> doing it\n", ""]);
});

for (const name of ["evaluate", "reproduce"]) {
  test(`${name} --help needs no compiler`, async () => {
    const env = { PATH: "", CARGO: "" };
    const { code, output } = await capture(process.execPath, ["scripts/tool.mjs", name, "--help"], { env });
    assert.equal(code, 0, output);
    assert.match(output, new RegExp(`Usage: npm run ${name} -- `));
  });
}
