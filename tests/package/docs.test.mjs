// The pages that `npm run docs` writes: what a newcomer reads first.
import { test } from "node:test";
import assert from "node:assert/strict";
import { existsSync, readFileSync } from "node:fs";
import { join } from "node:path";
import { capture, root } from "../../scripts/run.mjs";
import { project, write } from "./support.mjs";

test("the front page of the interface's documentation", async (t) => {
  const { folder } = await project(t);
  const pages = join(folder, "api");
  const typedoc = join(root, "node_modules/typedoc/bin/typedoc");
  const { code, output } = await capture("node", [typedoc, "--options", "typedoc.json", "--out", pages]);
  assert.equal(code, 0, output);
  const front = readFileSync(join(pages, "index.html"), "utf8");
  const [content] = front.match(/<div class="col-content">.*?<div class="col-sidebar">/s);

  await t.test("leads to every entry of the package and to what matters first", () => {
    const links = [...content.matchAll(/href="([\w./-]+\.html)"/g)].map(([, link]) => link);
    for (const link of links) assert.ok(existsSync(join(pages, link)), `${link} leads nowhere`);
    for (const entry of ["index", "dom", "react", "pointing", "slim", "study", "testing", "links", "overlay", "menu"])
      assert.ok(links.includes(`modules/${entry}.html`), `no link to ${entry}`);
    for (const name of [
      "classes/index.Predictor",
      "functions/index.pointerScenario",
      "functions/index.init",
      "functions/dom.watch",
      "functions/react.useIntent",
      "functions/testing.hand",
      "functions/links.links",
      "functions/menu.menu",
      "functions/menu.heldOpen",
      "functions/menu.handleClose",
      "functions/study.fit",
    ]) {
      assert.ok(links.includes(`${name}.html`), `no link to ${name}`);
    }
  });

  await t.test("begins with a program that prints what its comment states", async () => {
    const [, program] = readFileSync(join(root, "docs/interface.md"), "utf8").match(/^```ts\n(.*?)^```/ms);
    write(folder, "front.mjs", program);
    const { code, output } = await capture("node", ["front.mjs"], { cwd: folder });
    assert.equal(code, 0, output);
    assert.equal(output.trim(), program.match(/console\.log\(.*\); \/\/ (.*)/)[1]);
  });
});
