// Each way to load, with objects of every realm, in a thread of its own, so that each begins with nothing loaded.
import assert from "node:assert/strict";
import { readFileSync } from "node:fs";
import { createServer } from "node:http";
import { test } from "node:test";
import { Worker } from "node:worker_threads";

const file = new URL("../../dist/whither.wasm", import.meta.url);
const ways = {
  "the bytes in the package": "const { init } = whither; await init();",
  "initSync with a module": "whither.initSync({ module: new WebAssembly.Module(bytes) });",
  "initSync with bytes": "whither.initSync({ module: bytes });",
  "slim with a module": "await slim.init({ wasm: await WebAssembly.compile(bytes) });",
  "slim with an ArrayBuffer": "await slim.init({ wasm: bytes.buffer.slice(bytes.byteOffset, bytes.byteOffset + bytes.length) });",
  "slim with a promise of bytes": "await slim.init({ wasm: Promise.resolve(bytes) });",
  "slim with a Response": "await slim.init({ wasm: new Response(bytes) });",
  "slim with a promise of a Response": "await slim.init({ wasm: fetch(address) });",
  "slim with an address": "await slim.init({ wasm: address });",
  "slim with a URL": "await slim.init({ wasm: new URL(address) });",
  "initSync with shared memory": "whither.initSync({ module: shared(bytes) });",
  "slim with shared memory itself": "await slim.init({ wasm: shared(bytes).buffer });",
  "slim with a buffer that can be resized": "await slim.init({ wasm: resizable(bytes) });",
  "slim with a view of one": "await slim.init({ wasm: new DataView(resizable(bytes)) });",
  // what a test runner, an edge runtime or another window hands in: none of these is of a class of this realm
  "initSync with a module of another realm": "whither.initSync({ module: realm('new WebAssembly.Module(bytes)') });",
  "initSync with bytes of another realm": "whither.initSync({ module: realm('Uint8Array.from(bytes)') });",
  "init with a module of another realm": "await whither.init({ wasm: realm('new WebAssembly.Module(bytes)') });",
  "init with a promise of another realm": "await whither.init({ wasm: realm('WebAssembly.compile(bytes)') });",
  "init with options of another realm": "await whither.init(realm('({ wasm: new WebAssembly.Module(bytes) })'));",
  "slim with an ArrayBuffer of another realm": "await slim.init({ wasm: realm('Uint8Array.from(bytes).buffer') });",
  "slim with a view of another realm": "await slim.init({ wasm: realm('new DataView(Uint8Array.from(bytes).buffer)') });",
  "slim with a Response of another realm": `await slim.init({ wasm: realm(
    "new (class Response { ok = true; status = 200; url = ''; async arrayBuffer() { return Uint8Array.from(bytes).buffer; } })()",
  ) });`,
  "slim with a URL of another realm": "await slim.init({ wasm: realm('new (class URL { href = address })()') });",
  "slim with a module whose class is hidden":
    "await slim.init({ wasm: Object.setPrototypeOf(new WebAssembly.Module(bytes), null) });",
  "init overtaken by initSync": `
    const slow = slim.init({ wasm: WebAssembly.compile(bytes) });
    whither.initSync({ module: bytes });
    const made = new whither.Predictor(whither.pointerScenario([{ id: "a", x: 0, y: 0, width: 9, height: 9 }]));
    await slow;
    if (made.destinations.join() !== "a") throw new Error("it lives in another module");`,
};

const server = createServer((_, response) => {
  // Not "application/wasm": the type does not matter.
  response.writeHead(200, { "content-type": "application/octet-stream" }).end(readFileSync(file));
});
await new Promise((resolve) => server.listen(0, "127.0.0.1", resolve));
test.after(() => server.close());

for (const [name, load] of Object.entries(ways)) {
  test(name, async () => {
    const address = `http://127.0.0.1:${server.address().port}/any/name`;
    const script = `
      const [whither, slim, { parentPort }, { readFileSync }] =
        await Promise.all(["whither", "whither/slim", "node:worker_threads", "node:fs"].map((name) => import(name)));
      const bytes = readFileSync(new URL(${JSON.stringify(file.href)}));
      const address = ${JSON.stringify(address)};
      const { runInNewContext } = await import("node:vm");
      const realm = (program) => runInNewContext(program, { bytes, address });
      const fill = (buffer) => (new Uint8Array(buffer).set(bytes), buffer);
      const shared = ({ length }) => new Uint8Array(fill(new SharedArrayBuffer(length)));
      const resizable = ({ length }) => fill(new ArrayBuffer(length, { maxByteLength: 2 * length }));
      ${load}
      const target = { y: 0, width: 50, height: 50 };
      const scenario = whither.pointerScenario([{ id: "a", x: 0, ...target }, { id: "b", x: 500, ...target }]);
      const predictor = new slim.Predictor(scenario);
      for (let k = 0; k < 9; k++) predictor.observe(0.016 * k, [250 + 9 * k, 0]);
      parentPort.postMessage(predictor.best.id);`;
    const worker = new Worker(`(async () => {${script}})()`, { eval: true });
    const answer = await new Promise((resolve, reject) => worker.once("message", resolve).once("error", reject));
    await worker.terminate();
    assert.equal(answer, "b");
  });
}

test("the generated code hands over no more values than are passed on", () => {
  for (const name of ["whither", "pointing", "study"]) {
    const code = readFileSync(new URL(`../../js/generated/${name}.js`, import.meta.url), "utf8");
    const counts = [...code.matchAll(/\bwasm\.\w+\(([^()]*)\)/g)].map(
      ([, values]) => values.split(",").filter((value) => value.trim() !== "").length,
    );
    assert.ok(
      counts.length > 0 && Math.max(...counts) <= 6,
      `${name}: ${Math.max(...counts)} values; js/core/loading/instantiate.ts passes on 6`,
    );
  }
});
