// What both registries are given of the package, and what their pages show of it.
import { test } from "node:test";
import assert from "node:assert/strict";
import { readFileSync } from "node:fs";
import { join, posix } from "node:path";
import { versions, warnings } from "../../scripts/release.mjs";
import { capture, root } from "../../scripts/run.mjs";
import { project } from "./support.mjs";

const read = (name) => readFileSync(join(root, name), "utf8");
const npm = JSON.parse(read("package.json"));
const { packages } = JSON.parse(await cargo("metadata", "--no-deps", "--format-version", "1"));
const crate = packages.find(({ name }) => name === "whither");

async function cargo(...args) {
  const { code, output } = await capture("cargo", args);
  assert.equal(code, 0, output);
  return output.slice(output.search(/^\{/m));
}

/** The targets of a Markdown file's links and pictures that are no addresses, without their anchors. */
function links(text) {
  const prose = text.replace(/^```.*?^```$/gms, "").replace(/`[^`\n]*`/g, "");
  const targets = [
    ...prose.matchAll(/\]\(\s*<?([^)\s>]+)>?[^)]*\)/g),
    ...prose.matchAll(/(?:src|href)="([^"]+)"/g),
    ...prose.matchAll(/^\[[^\]]+\]:\s*(\S+)/gm),
  ];
  return targets.map(([, target]) => target.split("#")[0]).filter((target) => target !== "" && !/^[a-z]+:/.test(target));
}

function allFound(files, where) {
  const documents = files.filter((name) => name.endsWith(".md"));
  assert.ok(documents.includes("README.md"));
  const missing = documents.flatMap((name) =>
    links(read(name))
      .map((target) => posix.join(posix.dirname(name), target))
      .filter((path) => !files.includes(path))
      .map((path) => `${name}: ${path}`),
  );
  assert.deepEqual(missing, [], `what these name is not in the ${where}`);
}

test("links are found as Markdown has them", () => {
  const text =
    "![a](p.webp) [b](docs/x.md#part 'title') [c](#here) [d](https://e.org) `[e](no)`\n```\n[f](no)\n```\n<img src=\"i.png\">\n[g]: h.md\n";
  assert.deepEqual(links(text), ["p.webp", "docs/x.md", "i.png", "h.md"]);
  assert.ok(links(read("README.md")).includes("docs/demo.webp"), "README has its picture");
});

test("what README and the other pages link to is in what is published", async (t) => {
  await t.test("on npm", async (t) => allFound((await project(t)).files, "tarball"));
  await t.test("on crates.io", async () => {
    const { code, output } = await capture("cargo", ["package", "--list", "--allow-dirty", "--package", "whither"]);
    assert.equal(code, 0, output);
    allFound(output.trim().split("\n"), "crate");
  });
});

test("every file has the same version", () => {
  const found = versions();
  assert.deepEqual(
    Object.keys(found).filter((file) => found[file] !== crate.version),
    [],
  );
});

test("npm would publish it without a warning", async () => {
  const { code, output } = await capture("npm", ["publish", "--dry-run", "--ignore-scripts"]);
  assert.equal(code, 0, output);
  assert.deepEqual(warnings(output), []);
});

test("warnings are found in what the registries' clients print", () => {
  const found = ["npm warn publish npm auto-corrected some errors in your package.json", "warning: manifest has no license"];
  assert.deepEqual(warnings(["npm notice whither", ...found, "warning: aborting upload due to dry run"].join("\n")), found);
});

test("both registries are given the same", () => {
  const { name, license } = crate;
  assert.deepEqual({ name, license }, { name: npm.name, license: npm.license });
  const address = (repository) => (repository?.url ?? repository ?? null)?.replace(/^git\+|\.git$/g, "") ?? null;
  assert.equal(address(npm.repository), address(crate.repository));
  assert.equal(npm.homepage ?? null, crate.homepage);
});

test("docs.rs shows every feature that is for Rust", () => {
  const shown = crate.metadata.docs.rs.features;
  const forRust = Object.keys(crate.features).filter((name) => !name.startsWith("wasm"));
  const also = (name) => [name, ...crate.features[name].filter((item) => item in crate.features).flatMap(also)];
  const all = new Set(shown.flatMap(also));
  assert.deepEqual(
    forRust.filter((name) => !all.has(name)),
    [],
  );
});

test("no requirement of a crate is exact: the lock file pins, and others may have another patch", () => {
  const exact = packages.flatMap(({ dependencies }) =>
    dependencies.filter(({ req, path }) => !req.startsWith("^") && path === undefined),
  );
  assert.deepEqual(
    exact.map(({ name, req }) => `${name} ${req}`),
    [],
  );
});
