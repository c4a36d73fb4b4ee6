// What the shipped files are written in: what the promised engines read, and tools that read less.
import { test } from "node:test";
import assert from "node:assert/strict";
import { readFileSync, readdirSync } from "node:fs";
import { join } from "node:path";
import { transform } from "esbuild";
import { parseAst } from "rollup/parseAst";
import { project } from "./support.mjs";

/** README and `engines`. */
const floor = ["chrome94", "edge94", "firefox113", "safari16.4", "node20.19"];

/** What the floor reads and some tool of users' does not (Metro with React Native's preset: static blocks). */
const tooNew = {
  StaticBlock: () => true,
  // whither/dom, which is for pages alone, loads what it needs later
  ImportExpression: (_node, { name }) => name !== "dist/dom.js",
  MetaProperty: ({ meta }) => meta.name === "import",
  ImportAttribute: () => true,
  AwaitExpression: (_node, { functions }) => functions === 0,
  ForOfStatement: (node, { functions }) => node.await && functions === 0,
  BinaryExpression: ({ operator, left }) => operator === "in" && left.type === "PrivateIdentifier",
  Literal: ({ regex }) => regex !== undefined && /[dv]/.test(regex.flags),
};

test("the shipped files", async (t) => {
  const { folder, files } = await project(t);
  const installed = join(folder, "node_modules/whither");
  const scripts = files.filter((name) => name.endsWith(".js"));
  const ours = scripts.filter((name) => name.startsWith("dist/") && !/(bytes|keyboard)\.js$/.test(name));
  const read = (name) => readFileSync(join(installed, name), "utf8");

  await t.test("are the entries and what they import", () => {
    assert.ok(scripts.length >= 12, scripts.join());
    const atTop = readdirSync(installed).filter((name) => name.endsWith(".js"));
    assert.deepEqual(atTop.sort(), [
      "dom.js",
      "links.js",
      "menu.js",
      "overlay.js",
      "pointing.js",
      "react.js",
      "slim.js",
      "study.js",
      "testing.js",
    ]);
  });

  await t.test("stay the same when they are translated for the oldest engines that are promised", async () => {
    for (const name of scripts) {
      const [asItIs, translated] = await Promise.all(
        [undefined, floor].map((target) => transform(read(name), { minify: true, format: "esm", ...(target && { target }) })),
      );
      assert.equal(translated.code, asItIs.code, name);
    }
  });

  await t.test("have nothing in them that common tools do not read", () => {
    for (const name of scripts) {
      const found = [];
      visit(parseAst(read(name)), { name, functions: 0 }, (node, where) => {
        if (tooNew[node.type]?.(node, where)) found.push(node.type);
      });
      assert.deepEqual(found, [], name);
    }
  });

  await t.test("have short lines, which an uncaught error prints, but for the bytes and what runs in a page alone", () => {
    const inPages = ["dist/dom.js", "dist/prediction.js", "dist/react.js", "dist/links.js", "dist/overlay.js", "dist/menu.js"];
    for (const name of ours.filter((name) => !inPages.includes(name))) {
      const longest = Math.max(
        ...read(name)
          .split("\n")
          .map((line) => line.length),
      );
      assert.ok(longest < 600, `${name} has a line of ${longest}`);
    }
  });

  await t.test("lead to their places in js/, but for the bytes and another's library", () => {
    for (const name of ours) {
      const { sources, sourcesContent } = JSON.parse(read(`${name}.map`));
      assert.ok(sources.length > 0 && sources.length === sourcesContent.length, name);
      assert.ok(
        sources.every((source) => /^\.\.\/js\/[\w/.-]+$/.test(source)),
        `${name}: ${sources}`,
      );
      assert.ok(
        sourcesContent.every((text) => text.length > 0),
        name,
      );
    }
  });
});

function visit(node, where, callback) {
  if (Array.isArray(node)) {
    for (const item of node) visit(item, where, callback);
  } else if (typeof node?.type === "string") {
    callback(node, where);
    const inside = /Function/.test(node.type) ? { ...where, functions: where.functions + 1 } : where;
    for (const value of Object.values(node)) if (typeof value === "object") visit(value, inside, callback);
  }
}
