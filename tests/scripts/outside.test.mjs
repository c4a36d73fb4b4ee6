// The project names no folder outside itself.
import { test } from "node:test";
import assert from "node:assert/strict";
import { readFileSync, readdirSync } from "node:fs";
import { join } from "node:path";
import { root } from "../../scripts/run.mjs";

const made = new Set([".git", "node_modules", "target", "dist", "generated", "api"]);

/** The project's own texts, by their paths. */
function texts(folder = "") {
  return readdirSync(join(root, folder), { withFileTypes: true }).flatMap((entry) => {
    const path = folder === "" ? entry.name : `${folder}/${entry.name}`;
    if (entry.isDirectory()) return made.has(entry.name) ? [] : texts(path);
    return /\.(m?js|ts|rs|py|toml|json|html|css|md|txt)$/.test(path) && path !== "package-lock.json" ? [path] : [];
  });
}

/** What in a text leads out of the repository: paths with more steps up than the file is deep, and folders of one machine. */
function outside(path, text) {
  const depth = path.split("/").length - 1;
  const steps = [...text.matchAll(/(?:\.\.\/)+[\w.]*/g)]
    .map(([found]) => found)
    .filter((found) => found.split("../").length - 1 > depth);
  const machine = [...text.matchAll(/(?<![\w.$}~-])\/(?:work|home|root|Users|tmp)\/[\w./-]*|\.\.\/shared\/[\w./-]*/g)]
    .map(([found]) => found)
    // the folder that the pages share
    .filter((found) => !(path.startsWith("www/") && found.startsWith("../shared/")));
  return [...steps, ...machine];
}

test("no file names a folder outside the repository", () => {
  const all = texts();
  assert.ok(all.includes("README.md") && all.includes("src/lib.rs"), "this test no longer finds the files");
  const found = all
    .filter((path) => path !== "tests/scripts/outside.test.mjs")
    .flatMap((path) => {
      return outside(path, readFileSync(join(root, path), "utf8")).map((name) => `${path}: ${name}`);
    });
  assert.deepEqual(found, []);
});

test("such names are found", () => {
  assert.deepEqual(outside("tests/browser/a.mjs", 'new URL("../../../shared/data/", import.meta.url)'), [
    "../../../shared",
    "../shared/data/",
  ]);
  assert.deepEqual(outside("docs/a.md", "`npm run evaluate -- ../shared/data/*.jsonl`"), ["../shared/data/"]);
  assert.deepEqual(outside("a.md", "in /home/someone/data"), ["/home/someone/data"]);
  assert.deepEqual(outside("tests/browser/a.mjs", 'import "../../scripts/run.mjs"; // https://example.org/work/'), []);
});
