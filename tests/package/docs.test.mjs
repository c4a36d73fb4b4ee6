// The pages that `npm run docs` serves: what a newcomer reads first, and that every link leads somewhere.
import { test } from "node:test";
import assert from "node:assert/strict";
import { existsSync, readdirSync, readFileSync } from "node:fs";
import { join, posix } from "node:path";
import { capture, root } from "../../scripts/run.mjs";
import { project, write } from "./support.mjs";

test("the documentation", async (t) => {
  const { folder } = await project(t);
  const pages = join(folder, "api");
  const typedoc = join(root, "node_modules/typedoc/bin/typedoc");
  const { code, output } = await capture("node", [typedoc, "--options", "typedoc.json", "--out", pages]);
  assert.equal(code, 0, output);
  const front = readFileSync(join(pages, "index.html"), "utf8");
  const [content] = front.match(/<div class="col-content">.*?<div class="col-sidebar">/s);

  await t.test("has every document, and no link that leads nowhere", () => {
    // media are the examples that the documents link to
    const files = readdirSync(pages, { recursive: true }).filter((name) => /^(?!media\/).*\.html$/.test(name));
    assert.equal(
      files.filter((name) => name.startsWith("documents/")).length,
      readdirSync(join(root, "docs")).filter((name) => name.endsWith(".md") && name !== "interface.md").length,
    );
    const text = new Map(files.map((name) => [name, readFileSync(join(pages, name), "utf8")]));
    const ids = new Map(
      [...text].map(([name, page]) => [name, new Set([...page.matchAll(/ id="([^"]+)"/g)].map(([, id]) => id))]),
    );
    const lost = [];
    let found = 0;
    for (const [name, page] of text) {
      for (const [, link] of page.matchAll(/ (?:href|src)="([^"]+)"/g)) {
        if (/^[a-z]+:/.test(link)) continue;
        const [path, anchor] = link.replaceAll("&amp;", "&").split("#");
        const target = path ? posix.join(posix.dirname(name), decodeURIComponent(path)) : name;
        found += 1;
        // the demo beside it
        if (target === "../index.html") continue;
        if (!existsSync(join(pages, target)) || (anchor && ids.has(target) && !ids.get(target).has(decodeURIComponent(anchor))))
          lost.push(`${name}: ${link}`);
      }
    }
    assert.ok(found > 1000, `${found} links`);
    assert.deepEqual([...new Set(lost)], []);
  });

  await t.test("is where the demo's pages link to", () => {
    const html = readdirSync(join(root, "www"), { recursive: true }).filter((name) => /^(?!dist).*\.html$/.test(name));
    const links = html.flatMap((name) =>
      [...readFileSync(join(root, "www", name), "utf8").matchAll(/href="(?:\.\.?\/)+docs\/([^"#]+)/g)].map(([, link]) => link),
    );
    assert.ok(links.length > 0);
    for (const link of links) assert.ok(existsSync(join(pages, link)), link);
  });

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
