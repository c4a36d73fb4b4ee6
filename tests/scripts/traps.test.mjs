// What scripts/traps.mjs takes out of the WebAssembly, and what it leaves.
import { test } from "node:test";
import assert from "node:assert/strict";
import { mkdtempSync, readFileSync, rmSync, writeFileSync } from "node:fs";
import { tmpdir } from "node:os";
import { join } from "node:path";
import binaryen from "binaryen";
import { trapPanics } from "../../scripts/traps.mjs";

/** `src/a.rs` and its length, line 7 and column 9; a word as long that is no file; a number that looks like its address. */
const DATA = String.raw`src/a.rs\10\00\00\00\08\00\00\00\07\00\00\00\09\00\00\00meanings\10\00\00\00\07\00\00\00`;

const MODULE = `(module
  (memory (export "memory") 1)
  (data (i32.const 16) "${DATA}")
  (global $panics (mut i32) (i32.const 0))
  (func $"core[c593]::panicking::panic_fmt" (param i32) (global.set $panics (local.get 0)))
  (func $"hashbrown::raw::Fallibility::capacity_overflow" (result i32) (i32.const 3))
  (func (export "fail") (call $"core[c593]::panicking::panic_fmt" (i32.const 24)))
  (func (export "panics") (result i32) (global.get $panics))
  (func (export "go") (result i32) (call $"hashbrown::raw::Fallibility::capacity_overflow")))`;

/** The file of a module in a folder of its own. */
function fileOf(t, text) {
  const folder = mkdtempSync(join(tmpdir(), "whither-traps-"));
  t.after(() => rmSync(folder, { recursive: true, force: true }));
  const file = join(folder, "module.wasm");
  binaryen.setDebugInfo(true);
  writeFileSync(file, binaryen.parseText(text).emitBinary());
  return file;
}

test("a panic traps at once, and nothing else does", async (t) => {
  const file = fileOf(t, MODULE);
  await trapPanics(file);
  const { instance } = await WebAssembly.instantiate(readFileSync(file));
  const { fail, panics, go } = instance.exports;
  assert.throws(fail, WebAssembly.RuntimeError);
  assert.deepEqual([panics(), go()], [0, 3]);
});

test("places in source files are cleared with the files' names, and all other data stays", async (t) => {
  const file = fileOf(t, MODULE);
  await trapPanics(file);
  const { instance } = await WebAssembly.instantiate(readFileSync(file));
  const bytes = Buffer.from(instance.exports.memory.buffer, 16, 40);
  assert.deepEqual([...bytes.subarray(0, 24)], Array(24).fill(0));
  assert.equal(bytes.toString("latin1", 24, 32), "meanings");
  assert.deepEqual([bytes.readUInt32LE(32), bytes.readUInt32LE(36)], [16, 7]);
});

test("a module without panics or places, as another compiler names them, is an error and not a larger file", async (t) => {
  const renamed = MODULE.replaceAll("core[c593]::panicking", "core::fails");
  await assert.rejects(trapPanics(fileOf(t, renamed)), /no function of .*module\.wasm is called core::panicking::/);
  const elsewhere = MODULE.replace("src/a.rs", "src/a.go");
  await assert.rejects(trapPanics(fileOf(t, elsewhere)), /no place in a source file was found/);
  const returning = MODULE.replace("panicking::panic_fmt", "panicking::value")
    .replaceAll("panicking::panic_fmt", "panicking::value")
    .replace("(param i32) (global.set", "(param i32) (result i32) (i32.const 1) (global.set")
    .replace("(i32.const 24)))", "(i32.const 24)) drop)");
  await assert.rejects(trapPanics(fileOf(t, returning)), /returns something/);
});
