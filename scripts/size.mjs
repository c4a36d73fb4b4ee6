// `npm run size`: the sizes of the package, and which are within their budgets; the numbers in target/size.json.
import { mkdirSync, readFileSync, writeFileSync } from "node:fs";
import { join } from "node:path";
import { brotliCompressSync, constants, gzipSync } from "node:zlib";
import { build } from "./build.mjs";
import { main, root } from "./run.mjs";
import { table } from "./table.mjs";

/** Gzipped bytes, WebAssembly and JavaScript, that are wanted. */
const budgets = { pointing: 36_000, dom: 8_000, links: 5_500, react: 3_000, whither: 175_000 };

const parts = [
  {
    name: "`whither/pointing`, as it is packed",
    files: ["pointing.js", "error.js", "pointing-bytes.js"],
    budget: budgets.pointing,
  },
  { name: "of it the JavaScript", files: ["pointing.js", "error.js"] },
  { name: "its file of WebAssembly", files: ["pointing.wasm"] },
  { name: "`whither/dom`, without what it loads later", files: ["dom.js", "error.js"], budget: budgets.dom },
  { name: "what it loads when a pointer moves, besides `whither/pointing`", files: ["prediction.js"] },
  { name: "what its `reasons.keyboard` loads", files: ["keyboard.js"] },
  { name: "`whither/react`, besides `whither/dom` and React", files: ["react.js"], budget: budgets.react },
  { name: "`whither/testing`", files: ["testing.js", "error.js"] },
  { name: "`whither/links`, besides `whither/dom`", files: ["links.js"], budget: budgets.links },
  { name: "`whither/overlay`, beside `whither/dom`", files: ["overlay.js"] },
  { name: "`whither/menu`, beside `whither/dom`", files: ["menu.js"] },
  { name: "`whither`, as it is packed", files: ["index.js", "shared.js", "error.js", "bytes.js"], budget: budgets.whither },
  { name: "of it the JavaScript", files: ["index.js", "shared.js", "error.js"] },
  { name: "its file of WebAssembly", files: ["whither.wasm"] },
  { name: "`whither/slim` and that file", files: ["slim.js", "shared.js", "error.js", "whither.wasm"] },
  { name: "`whither/study`, as it is packed", files: ["study.js", "error.js", "study-bytes.js"] },
];

/** `{ name, raw, gzip, brotli, budget? }` in bytes for each part of the package that is in `dist`, each file packed by itself. */
export function sizes(dist = join(root, "dist")) {
  const known = new Map();
  const measure = (file) => {
    if (!known.has(file)) {
      const bytes = readFileSync(join(dist, file));
      const gzip = gzipSync(bytes, { level: constants.Z_BEST_COMPRESSION }).length;
      known.set(file, { raw: bytes.length, gzip, brotli: brotliCompressSync(bytes).length });
    }
    return known.get(file);
  };
  return parts.map(({ name, files, budget }) => {
    const sum = (key) => files.reduce((total, file) => total + measure(file)[key], 0);
    return { name, raw: sum("raw"), gzip: sum("gzip"), brotli: sum("brotli"), budget };
  });
}

/** Prints them. */
export function showSizes(rows) {
  const kilobytes = (bytes) => (bytes / 1000).toFixed(1);
  const budget = ({ gzip, budget }) => (budget ? `${kilobytes(budget)}, ${gzip <= budget ? "met" : "missed"}` : "");
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
