// docs/hand-tracking.md: its programs, and the module that it gives, which is the demo's.
import assert from "node:assert/strict";
import { mkdtempSync, readFileSync, rmSync, writeFileSync } from "node:fs";
import { join } from "node:path";
import { test } from "node:test";
import { transformSync } from "esbuild";
import { capture, root } from "../../scripts/run.mjs";

const page = readFileSync(join(root, "docs/hand-tracking.md"), "utf8");
const blocks = (language) => [...page.matchAll(new RegExp(`^\`\`\`${language}\n(.*?)^\`\`\``, "gms"))].map(([, code]) => code);
const [camera, module, ...more] = blocks("ts");

test("the module is the one that the demo has, and that is tested", () => {
  assert.equal(module, readFileSync(join(root, "www/cockpit/tracker.ts"), "utf8"));
  assert.deepEqual(more, []);
});

test("the program prints what its comments state", async (t) => {
  // in the repository, where the package is found by its name
  const folder = mkdtempSync(join(root, "target/hand-tracking-"));
  t.after(() => rmSync(folder, { recursive: true }));
  writeFileSync(join(folder, "tracker.js"), transformSync(module, { loader: "ts", format: "esm" }).code);
  const program = blocks("js").join("");
  writeFileSync(join(folder, "program.mjs"), program);
  const { code, output } = await capture("node", [join(folder, "program.mjs")], { cwd: folder });
  assert.equal(code, 0, output);
  const promised = [...program.matchAll(/^console\.log\(.*\); \/\/ (.*)$/gm)].map(([, comment]) => comment);
  assert.equal(promised.length, 4);
  assert.deepEqual(output.trim().split("\n"), promised);
});

test("what needs a camera is a program, too, and feeds the others", () => {
  assert.doesNotThrow(() => transformSync(camera, { loader: "ts", format: "esm" }));
  for (const name of ["onLandmarks", "onCorner"]) {
    assert.match(camera, new RegExp(`\\b${name}\\b`));
    assert.match(page, new RegExp(`^function ${name}\\(`, "m"));
  }
});
