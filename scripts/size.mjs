// `npm run size`: what the package weighs, and whether its core is within the budget; the numbers in target/size.json.
import { mkdirSync, readFileSync, writeFileSync } from "node:fs";
import { join } from "node:path";
import { brotliCompressSync, constants, gzipSync } from "node:zlib";
import { build } from "./build.mjs";
import { main, root } from "./run.mjs";
import { table } from "./table.mjs";

/** Gzipped bytes of the core, WebAssembly and JavaScript, that are wanted: design section 5. */
export const BUDGET = 80_000;

const parts = [
  { name: "WebAssembly", files: ["whither.wasm"] },
  { name: "JavaScript", files: ["index.js", "shared.js"] },
  { name: "core: both", files: ["whither.wasm", "index.js", "shared.js"] },
  { name: "`whither`, the WebAssembly inside it", files: ["index.js", "shared.js", "bytes.js"] },
  { name: "`whither/slim` and its file", files: ["slim.js", "shared.js", "whither.wasm"] },
  { name: "`whither/study`, beside it", files: ["study.js", "study-bytes.js", "shared.js"] },
];

/** `{ name, raw, gzip, brotli }` in bytes for each part of the package that is in `dist`, each file packed by itself. */
export function sizes(dist = join(root, "dist")) {
  const weights = new Map();
  const weigh = (file) => {
    if (!weights.has(file)) {
      const bytes = readFileSync(join(dist, file));
      const gzip = gzipSync(bytes, { level: constants.Z_BEST_COMPRESSION }).length;
      weights.set(file, { raw: bytes.length, gzip, brotli: brotliCompressSync(bytes).length });
    }
    return weights.get(file);
  };
  return parts.map(({ name, files }) => {
    const sum = (key) => files.reduce((total, file) => total + weigh(file)[key], 0);
    return { name, raw: sum("raw"), gzip: sum("gzip"), brotli: sum("brotli") };
  });
}

/** Prints them. */
export function showSizes(rows) {
  const kilobytes = (bytes) => (bytes / 1000).toFixed(1);
  const budget = (row) => (row.name.startsWith("core") ? `${kilobytes(BUDGET)}, ${row.gzip <= BUDGET ? "met" : "missed"}` : "");
  const cells = rows.map((row) => [row.name, ...[row.raw, row.gzip, row.brotli].map(kilobytes), budget(row)]);
  table(["kB", "raw", "gzip", "brotli", "budget (gzip)"], cells);
}

await main(import.meta.url, async () => {
  await build();
  const rows = sizes();
  showSizes(rows);
  mkdirSync(join(root, "target"), { recursive: true });
  writeFileSync(join(root, "target/size.json"), `${JSON.stringify(rows, null, 2)}\n`);
});
