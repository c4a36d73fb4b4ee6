// The example of docs/foresight.md, before and after: both programs run on the same page, and both fetch ahead.
import assert from "node:assert/strict";
import { readFileSync } from "node:fs";
import { mkdtemp, rm, writeFile } from "node:fs/promises";
import { tmpdir } from "node:os";
import { after, before, describe, it } from "node:test";
import { join } from "node:path";
import * as esbuild from "esbuild";
import { launch } from "../../scripts/chromium.mjs";
import { root } from "../../scripts/run.mjs";
import { serve } from "../../scripts/serve.mjs";
import { movement } from "../browser/hand.mjs";
import { mouse, nextFrame, REST } from "./support.mjs";

const text = readFileSync(join(root, "docs/foresight.md"), "utf8");
const programs = [...text.matchAll(/^```js\n(.*?)^```/gms)].map(([, program]) => program);

const page = (
  script,
) => `<!doctype html><html lang="en"><meta charset="utf-8"><title>A page</title><link rel="icon" href="data:,">
<style>body { margin: 0 } a { position: absolute; width: 90px; height: 40px; background: #ace }</style>
<nav>${["north", "east", "south", "west"]
  .map(
    (id, i) => `<a id="${id}" href="/${id}" style="left:${[440, 840, 440, 60][i]}px;top:${[60, 320, 600, 320][i]}px">${id}</a>`,
  )
  .join("")}</nav>
<script>
  window.fetched = [];
  window.shown = [];
  window.prefetch = async (address) => void fetched.push(new URL(address).pathname.slice(1));
  window.show = (line) => shown.push(line);
</script>
<script type="module" src="${script}"></script></html>`;

describe("the example for users of ForesightJS", () => {
  let folder, host, browser;
  before(async () => {
    folder = await mkdtemp(join(tmpdir(), "whither-foresight-"));
    const entryPoints = programs.slice(0, 2).map((_, i) => join(folder, `${["before", "after"][i]}.js`));
    await Promise.all(entryPoints.map((file, i) => writeFile(file, programs[i])));
    await esbuild.build({
      absWorkingDir: root,
      entryPoints,
      bundle: true,
      splitting: true,
      format: "esm",
      outdir: join(folder, "site"),
      nodePaths: [join(root, "node_modules")],
      alias: { "whither/dom": join(root, "dist/dom.js") },
      logLevel: "warning",
    });
    for (const name of ["before", "after"]) await writeFile(join(folder, `site/${name}.html`), page(`${name}.js`));
    host = await serve(join(folder, "site"));
    browser = await launch();
  });
  after(async () => {
    await browser?.close();
    await host?.close();
    await rm(folder, { recursive: true });
  });

  for (const [name, kinds, share] of [
    // by the clock of its frames, which a machine under load has few of: so to the end
    ["before", { moved: "mouse", tabbed: "tab" }, 1],
    // by the times of the events; the link begins at nine tenths of the way
    ["after", { moved: "pointer", tabbed: "keyboard" }, 0.66],
  ]) {
    it(`${name}: fetches the link that the mouse goes to, once, and those next to be tabbed to`, async () => {
      const tab = await browser.newPage({ viewport: { width: 1000, height: 700 } });
      const errors = [];
      tab.on("pageerror", (error) => errors.push(String(error)));
      await tab.goto(`${host.url}${name}.html`);
      const hand = await mouse(tab);
      const [from, to] = [
        { x: 485, y: 350 },
        { x: 885, y: 340 },
      ];
      // what loads at the first movement is there then
      await hand.play([[0, from.x, from.y - 2]]);
      await tab.waitForTimeout(500);
      await hand.play([[0, from.x, from.y]]);
      await hand.rest(REST);
      await hand.play(movement(from, to, 40, { seed: 3, share }));
      await nextFrame(tab);
      const { fetched, shown, over } = await tab.evaluate(() => ({
        fetched,
        shown,
        over: document.querySelector("a:hover") !== null,
      }));
      assert.deepEqual([fetched, shown, over], [["east"], [`east: ${kinds.moved}`], share === 1]);
      await tab.keyboard.press("Tab");
      // from the first link on, two tab stops farther
      await tab.waitForFunction((line) => shown.includes(line), `south: ${kinds.tabbed}`, { timeout: 5000 });
      assert.equal(await tab.evaluate(() => fetched.filter((id) => id === "east").length), 1);
      assert.deepEqual(errors, []);
      await tab.close();
    });
  }
});
