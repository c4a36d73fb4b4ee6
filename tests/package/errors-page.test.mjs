// docs/errors.md: every code, and that each example ends in the error that is stated.
import { test } from "node:test";
import assert from "node:assert/strict";
import { readFileSync } from "node:fs";
import { join } from "node:path";
import { capture, root } from "../../scripts/run.mjs";
import { project, write } from "./support.mjs";

test("the page of errors", async (t) => {
  const { folder } = await project(t);
  const page = readFileSync(join(root, "docs/errors.md"), "utf8");
  const [first, ...sections] = page.split(/^## `/m);
  const programs = (text) => [...text.matchAll(/^```js\n(.*?)^```/gms)].map(([, program]) => program);
  const [begin] = programs(first);

  await t.test("has every code once, in the order of their declaration", () => {
    const declared = readFileSync(join(root, "js/core/error.ts"), "utf8").match(/type ErrorCode =([^;]+);/)[1];
    const codes = [...declared.matchAll(/"([\w-]+)"/g)].map(([, code]) => code);
    assert.deepEqual(
      sections.map((section) => section.split("`")[0]),
      codes,
    );
  });

  await t.test("begins with a program that prints what its comment states", async () => {
    write(folder, "begin.mjs", begin);
    const { code, output } = await capture("node", ["begin.mjs"], { cwd: folder });
    assert.equal(code, 0, output);
    assert.equal(output.trim(), begin.match(/console\.log\(.*\); \/\/ (.*)/)[1]);
  });

  for (const section of sections) {
    const code = section.split("`")[0];
    const [example] = programs(section);
    if (example === undefined) continue;
    await t.test(`throws ${code} where it states so`, async () => {
      const lines = example.trim().split("\n");
      const message = lines.pop().replace("// ", "");
      const caught = `try {\n${lines.join("\n")}\n} catch ({ code, message }) {\n  console.log(JSON.stringify({ code, message }));\n}\n`;
      write(folder, `${code}.mjs`, begin + caught);
      const { output } = await capture("node", [`${code}.mjs`], { cwd: folder });
      assert.deepEqual(JSON.parse(output.trim().split("\n").at(-1)), { code, message });
    });
  }

  await t.test("states when an object is made too early", async () => {
    write(folder, "early.mjs", begin.replace("await init();\n", ""));
    const { output } = await capture("node", ["early.mjs"], { cwd: folder });
    assert.match(output, /not-initialised/);
  });
});
