// From an import that does nothing to a loaded module, in one story: each test goes on where the last one ended.
import assert from "node:assert/strict";
import { spawnSync } from "node:child_process";
import { readFileSync } from "node:fs";
import { createServer } from "node:http";
import { after, before, test } from "node:test";
import { runInNewContext } from "node:vm";
import { gzipSync } from "node:zlib";
import { fit } from "whither/study";
import * as slim from "whither/slim";
import { ConditionallyMarkovSequence, init, initSync, pointerScenario, Predictor, WhitherError } from "whither";
import { refuses, small } from "./support.mjs";

const bytes = readFileSync(new URL("../../dist/whither.wasm", import.meta.url));
const answers = {
  "/missing.wasm": [404, "text/plain", "not here"],
  "/page.wasm": [200, "text/html", "<!doctype html><title>Not found</title>"],
  "/mislabelled.wasm": [200, "text/plain", bytes],
};
const server = createServer(({ url }, response) => {
  const [status, type, body] = answers[url];
  response.writeHead(status, { "content-type": type }).end(body);
});
let origin;

before(async () => {
  await new Promise((resolve) => server.listen(0, "127.0.0.1", resolve));
  origin = `http://127.0.0.1:${server.address().port}`;
});
after(() => server.close());

async function fails(promise, code, message) {
  await assert.rejects(promise, (error) => {
    assert.ok(error instanceof WhitherError);
    assert.deepEqual([error.code, error.message], [code, message]);
    return true;
  });
}

test("nothing works before init", () => {
  const message = "call init() and wait for it first: await init()";
  for (const use of [
    () => new Predictor(small()),
    () => Predictor.restore({ version: 1 }),
    () => new ConditionallyMarkovSequence({}),
    () => ConditionallyMarkovSequence.fromParameters({}),
    () => pointerScenario([]),
  ]) {
    refuses(use, "not-initialised", "", message);
  }
});

test("whither/slim rejects without the location of the WebAssembly", async () => {
  await fails(slim.init(), "missing-key", 'wasm: missing key "wasm": whither/slim has no bytes of its own');
});

test("an address that answers 404", async () => {
  const address = `${origin}/missing.wasm`;
  await fails(slim.init({ wasm: address }), "wasm-unavailable", `${address} answered with status 404`);
  await fails(init({ wasm: fetch(address) }), "wasm-unavailable", `${address} answered with status 404`);
});

test("an address that answers with a page", async () => {
  const address = new URL(`${origin}/page.wasm`);
  const message = `the answer from ${address} must be WebAssembly, is an HTML page`;
  await fails(init({ wasm: address }), "wasm-unavailable", message);
});

test("an address that does not answer", async () => {
  const message = "http://127.0.0.1:1/whither.wasm cannot be fetched: fetch failed";
  await fails(init({ wasm: "http://127.0.0.1:1/whither.wasm" }), "wasm-unavailable", message);
  await fails(init({ wasm: Promise.reject(new Error("no")) }), "wasm-unavailable", "the promise of it was rejected: no");
});

test("bytes that are no WebAssembly, or none of ours", async () => {
  const text = new TextEncoder().encode("hello");
  const message = 'the given bytes must be WebAssembly, begins with "hello"';
  await fails(init({ wasm: text }), "wasm-unavailable", message);
  refuses(() => initSync({ module: text }), "wasm-unavailable", "", message);
  const empty = Uint8Array.of(0, 0x61, 0x73, 0x6d, 1, 0, 0, 0);
  const other = "the module is not this version's whither.wasm: it has no __wbindgen_start";
  await fails(init({ wasm: empty }), "wasm-unavailable", other);
  refuses(() => initSync({ module: new WebAssembly.Module(empty) }), "wasm-unavailable", "", other);
});

test("something that is no source at all", async () => {
  const message = "wasm: must be an address, a Response, the bytes or a WebAssembly.Module";
  await fails(init({ wasm: 5 }), "wrong-type", message);
  await fails(slim.init({ wasm: null }), "wrong-type", message);
  refuses(() => initSync({ module: "x" }), "wrong-type", "module", "must be a WebAssembly.Module or its bytes");
  refuses(() => initSync(), "wrong-type", "module", "must be a WebAssembly.Module or its bytes");
});

test("the error for truncated or damaged bytes names them, and neither a policy nor the engine", async () => {
  const change = (at, byte) => Uint8Array.from(bytes).fill(byte, at, at + 1);
  const cases = [8, 9, 1000, bytes.length >> 1, bytes.length - 1].map((length) => bytes.subarray(0, length));
  for (const wasm of [...cases.slice(1), change(4, 2), change(8, 255), change(12, 255)]) {
    await assert.rejects(slim.init({ wasm }), ({ code, message }) => {
      assert.equal(code, "wasm-unavailable");
      const start = `the given bytes must be WebAssembly, is damaged or cut off after ${wasm.length} bytes: `;
      assert.ok(message.startsWith(start), message);
      assert.match(message, /@\+\d+/, "the place that the engine names");
      assert.doesNotMatch(message, /policy|SIMD/i);
      return true;
    });
    assert.throws(() => initSync({ module: wasm }), { code: "wasm-unavailable", message: /damaged or cut off/ });
  }
  await fails(
    slim.init({ wasm: cases[0] }),
    "wasm-unavailable",
    "the module is not this version's whither.wasm: it has no __wbindgen_start",
  );
  const gone = new ArrayBuffer(8);
  structuredClone(gone, { transfer: [gone] });
  const detached = "the given bytes cannot be read: Cannot perform Construct on a detached ArrayBuffer";
  await fails(slim.init({ wasm: gone }), "wasm-unavailable", detached);
  await fails(slim.init({ wasm: new Uint8Array() }), "wasm-unavailable", "the given bytes must be WebAssembly, has no bytes");
  await fails(slim.init({ wasm: gzipSync(bytes) }), "wasm-unavailable", "the given bytes must be WebAssembly, is gzipped");
});

test("an engine without SIMD gets an error that names it", { skip: process.arch !== "x64" }, () => {
  // V8 has no SIMD without these instructions of the processor
  const program = 'import("whither").then(({ init }) => init()).then(() => 0, ({ code, message }) => console.log(code, message))';
  const run = spawnSync(process.execPath, ["--no-enable-ssse3", "--no-enable-sse4-1", "-e", program], { encoding: "utf8" });
  assert.match(run.stdout, /^wasm-unavailable the WebAssembly of this engine has no SIMD: /, run.stderr);
});

test("what a promise is rejected with is in the message, whatever it is", async () => {
  const reports = async (value, what) => {
    await fails(init({ wasm: Promise.reject(value) }), "wasm-unavailable", `the promise of it was rejected: ${what}`);
  };
  await reports(runInNewContext('new TypeError("of another realm")'), "of another realm");
  await reports("words", "words");
  await reports(Symbol("x"), "Symbol(x)");
  await reports(undefined, "undefined");
  await reports(null, "[object Null]");
  await reports(Object.create(null), "[object Object]");
});

test("WebAssembly that is not allowed, or does not exist", async (t) => {
  t.mock.method(WebAssembly, "compile", async () => {
    throw new WebAssembly.CompileError("blocked by the policy");
  });
  const message =
    "WebAssembly was refused here: blocked by the policy " +
    "(a Content-Security-Policy needs 'wasm-unsafe-eval' in script-src, and nothing else)";
  await fails(init(), "wasm-unavailable", message);
  const { WebAssembly: present } = globalThis;
  globalThis.WebAssembly = undefined;
  try {
    const message = "WebAssembly does not exist here";
    await fails(init(), "wasm-unavailable", message);
    await fails(slim.init(), "wasm-unavailable", message);
    await fails(fit([], {}), "wasm-unavailable", message);
    refuses(() => initSync({ module: bytes }), "wasm-unavailable", "", message);
  } finally {
    globalThis.WebAssembly = present;
  }
});

test("what is missing of the platform is named", async () => {
  for (const name of ["TextDecoder", "TextEncoder"]) {
    const present = globalThis[name];
    globalThis[name] = undefined;
    try {
      await fails(init(), "wasm-unavailable", `${name} does not exist here`);
    } finally {
      globalThis[name] = present;
    }
  }
});

test("bytes inside the package that cannot be unpacked", async (t) => {
  t.mock.method(globalThis, "atob", () => "no gzip at all");
  await assert.rejects(init(), {
    code: "wasm-unavailable",
    message: /^the WebAssembly inside the package cannot be unpacked: .+; use init\(\{ wasm \}\) with whither\/whither\.wasm$/,
  });
});

test("without DecompressionStream", async () => {
  const { DecompressionStream: present } = globalThis;
  globalThis.DecompressionStream = undefined;
  try {
    const message = "DecompressionStream does not exist here: use init({ wasm }) with whither/whither.wasm";
    await fails(init(), "wasm-unavailable", message);
  } finally {
    globalThis.DecompressionStream = present;
  }
});

test("after all these failures, two at once share one load", async (t) => {
  const compile = t.mock.method(WebAssembly, "compile");
  const first = init();
  assert.equal(init(), first);
  assert.equal(slim.init({ wasm: `${origin}/missing.wasm` }), first);
  await first;
  assert.equal(compile.mock.callCount(), 1);
});

test("once it is loaded, init and initSync do nothing", async (t) => {
  const compile = t.mock.method(WebAssembly, "compile");
  await init();
  await slim.init({ wasm: "never looked at" });
  initSync({ module: new WebAssembly.Module(bytes) });
  assert.equal(compile.mock.callCount(), 0);
  assert.equal(new Predictor(small()).destinations.length, 3);
});
