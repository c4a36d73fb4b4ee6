// Each way to load, in a thread of its own, so that each begins with nothing loaded.
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
