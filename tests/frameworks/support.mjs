// What the tests of frameworks share: their packages, installed apart, and pages that are bundled with them and opened in Chromium.
import assert from "node:assert/strict";
import { cpSync, mkdirSync } from "node:fs";
import { mkdtemp, rm, writeFile } from "node:fs/promises";
import { tmpdir } from "node:os";
import { join } from "node:path";
import { pathToFileURL } from "node:url";
import * as esbuild from "esbuild";
import { incremental } from "../../scripts/incremental.mjs";
import { root, run } from "../../scripts/run.mjs";
import { movement } from "../browser/hand.mjs";
import { mouse, nextFrame, REST } from "../browser/support.mjs";

export { hosted } from "../dom/support.mjs";
export { nextFrame, REST };

/** A project with what package.json beside this file names, which stays from run to run. */
export const folder = join(root, "target/frameworks");

const from = "tests/frameworks";
const inputs = ["package.json", "package-lock.json"].map((name) => `${from}/${name}`);
const outputs = ["target/frameworks/node_modules/vue"];
await incremental("frameworks", { inputs, outputs, doing: `installing what ${from}/package.json names` }, async () => {
  mkdirSync(folder, { recursive: true });
  for (const name of inputs) cpSync(join(root, name), join(folder, name.slice(from.length)));
  // React 18 and 19 side by side, each with its own react-dom, whose wish for a package named react npm would take for a conflict
  const quietly = ["--no-audit", "--no-fund", "--loglevel=error", "--ignore-scripts"];
  await run("npm", ["ci", "--legacy-peer-deps", ...quietly], { cwd: folder });
});

/** What a user's program imports, as it is built. */
const whither = Object.fromEntries(["dom", "react"].map((name) => [`whither/${name}`, join(root, `dist/${name}.js`)]));

/** Names of one version of React for the other's. */
export function reactAliases(version) {
  return { react: `react-${version}`, "react-dom": `react-dom-${version}` };
}

/** A program that is no file, as the file `text:program` beside the packages. */
const textual = (contents) => ({
  name: "textual",
  setup({ onResolve, onLoad }) {
    onResolve({ filter: /^text:/ }, ({ path }) => ({ path, namespace: "text" }));
    onLoad({ filter: /./, namespace: "text" }, () => ({ contents, resolveDir: folder, loader: "jsx" }));
  },
});

/** Bundles a program, a path or, where it has several lines, a text: gives its files by their names. */
export async function bundle(program, { alias = {}, plugins = [], name = "program", ...options } = {}) {
  const { outputFiles } = await esbuild.build({
    absWorkingDir: folder,
    // beside node_modules, so that what it imports is found there
    entryPoints: { [name]: program.includes("\n") ? "text:program" : program },
    nodePaths: [join(folder, "node_modules")],
    alias: { ...whither, ...alias },
    plugins: [textual(program), ...plugins],
    bundle: true,
    jsx: "automatic",
    splitting: true,
    format: "esm",
    target: "chrome120",
    define: { "process.env.NODE_ENV": '"development"' },
    outdir: "site",
    write: false,
    logLevel: "warning",
    ...options,
  });
  return Object.fromEntries(outputFiles.map(({ path, text }) => [path.slice(join(folder, "site/").length), text]));
}

/** Renderers on a server ask for modules of Node. */
const banner = { js: 'import { createRequire } from "node:module"; const require = createRequire("/");' };

/** Bundles a program for Node, runs it, and gives what it exports. */
export async function inNode(program, options) {
  const files = await bundle(program, { platform: "node", conditions: ["node"], banner, ...options });
  const made = await mkdtemp(join(tmpdir(), "whither-server-"));
  for (const [name, text] of Object.entries(files)) await writeFile(join(made, name), text);
  await writeFile(join(made, "package.json"), '{ "type": "module" }');
  try {
    return await import(pathToFileURL(join(made, "program.js")));
  } finally {
    await rm(made, { recursive: true });
  }
}

/**
 * Opens a page of these files, whose program is `program.js`. What the page reports as an error or a warning fails the test, unless it has
 * emptied the list `problems` before it is over.
 */
export async function open(t, site, files, { body = "", head = "" } = {}) {
  const context = await site.browser.newContext({ viewport: { width: 1000, height: 700 } });
  const page = await context.newPage();
  const problems = [];
  page.on("pageerror", (error) => problems.push(`error: ${error.message}`));
  page.on("console", (message) => {
    if (["error", "warning"].includes(message.type())) problems.push(`console: ${message.text()}`);
  });
  const html = `<!doctype html><html lang="en"><head><meta charset="utf-8"><title>A page</title><link rel="icon" href="data:,">
<style>body { margin: 0 }</style>${head}</head><body><div id="root">${body}</div><script type="module" src="./program.js"></script></body></html>`;
  const all = { "page.html": html, ...files };
  for (const [name, text] of Object.entries(all)) {
    const contentType = name.endsWith(".html") ? "text/html; charset=utf-8" : "text/javascript";
    await page.route(`${site.url}${name}`, (route) => route.fulfill({ body: text, contentType }));
  }
  t.after(async () => {
    await context.close();
    assert.deepEqual(problems, []);
  });
  await page.goto(`${site.url}page.html`);
  return { page, problems, hand: await mouse(page) };
}

/** The middle of an element. */
export async function middle(page, selector) {
  const { x, y, width, height } = await page.locator(selector).boundingBox();
  return { x: x + width / 2, y: y + height / 2, size: Math.min(width, height) };
}

/** Moves a hand from one place to another. */
export async function reach(page, hand, from, to) {
  await hand.play([[0, from.x, from.y]]);
  await hand.rest(REST);
  await hand.play(movement(from, to, to.size, { seed: 3 }));
  await nextFrame(page);
}
