import assert from "node:assert/strict";
import { mkdtemp, rm, writeFile } from "node:fs/promises";
import { request } from "node:http";
import { tmpdir } from "node:os";
import { join } from "node:path";
import { after, before, describe, it } from "node:test";
import { gunzipSync } from "node:zlib";
import { serve } from "../../scripts/serve.mjs";

const TEXT = "<p>text</p>".repeat(1000);

describe("the server", () => {
  let folder, site;
  before(async () => {
    folder = await mkdtemp(join(tmpdir(), "whither-serve-"));
    await writeFile(join(folder, "index.html"), TEXT);
    await writeFile(join(folder, "font.woff2"), TEXT);
    site = await serve(folder, { path: "/sub/" });
  });
  after(async () => {
    await site.close();
    await rm(folder, { recursive: true });
  });

  /** What is answered, as it comes over the wire. */
  const get = (path, headers = {}) =>
    new Promise((resolve, reject) => {
      const asked = request(new URL(path, site.url), { headers }, async (response) => {
        const { statusCode: status, headers } = response;
        resolve({ status, headers, body: Buffer.concat(await response.toArray()) });
      });
      asked.on("error", reject).end();
    });

  it("packs text for those who take it, and nothing else", async () => {
    const packed = await get("", { "accept-encoding": "br, gzip" });
    assert.equal(packed.headers["content-encoding"], "gzip");
    assert.ok(packed.body.length < 500);
    assert.equal(gunzipSync(packed.body).toString(), TEXT);
    const plain = await get("index.html");
    assert.deepEqual([plain.headers["content-encoding"], plain.body.toString()], [undefined, TEXT]);
    const font = await get("font.woff2", { "accept-encoding": "gzip" });
    assert.deepEqual([font.headers["content-encoding"], font.body.toString()], [undefined, TEXT]);
  });

  it("gives nothing outside its folder", async () => {
    for (const path of ["nowhere.html", "..%2f..%2fetc/passwd", "/", "%zz"]) assert.equal((await get(path)).status, 404, path);
  });
});
