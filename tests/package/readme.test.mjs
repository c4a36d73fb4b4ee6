// The README's own code, followed to the letter: in Node, and on a page over which the real mouse moves.
import { test } from "node:test";
import assert from "node:assert/strict";
import { readFileSync } from "node:fs";
import { join } from "node:path";
import * as esbuild from "esbuild";
import { launch } from "../../scripts/chromium.mjs";
import { capture, root } from "../../scripts/run.mjs";
import { serve } from "../../scripts/serve.mjs";
import { project, write } from "./support.mjs";

const readme = readFileSync(join(root, "README.md"), "utf8");
const [onAPage, inNode, learning, ...rest] = [...readme.matchAll(/^```js\n(.*?)^```$/gms)].map(([, code]) => code);

test("the README's code", async (t) => {
  const { folder } = await project(t);

  await t.test("there are three programs", () => assert.deepEqual([learning !== undefined, rest.length], [true, 0]));

  for (const [name, program] of Object.entries({ inNode, learning })) {
    await t.test(`in Node prints what its comments say: ${name}`, async () => {
      write(folder, `${name}.mjs`, program);
      const { code, output } = await capture("node", [`${name}.mjs`], { cwd: folder });
      assert.equal(code, 0, output);
      const promised = [...program.matchAll(/^console\.log\(.*\); \/\/ (.*)$/gm)].map(([, comment]) => comment);
      assert.ok(promised.length > 1);
      assert.deepEqual(output.trim().split("\n"), promised);
    });
  }

  for (const entry of ["whither", "whither/pointing"]) {
    await t.test(`on a page, from ${entry}, marks the icon that the mouse is going to, before it is there`, async () => {
      const icon = (id, left) => `<i data-icon id="${id}" style="position:fixed;top:300px;left:${left}px;width:96px;height:96px"></i>`;
      const icons = [0, 1, 2, 3].map((i) => icon(`icon${i}`, 100 + 300 * i)).join("");
      write(folder, "site/index.html", `<!doctype html><link rel="icon" href="data:,">${icons}<script type="module" src="main.js"></script>`);
      write(folder, "main.js", onAPage.replace(/from "whither[^"]*"/, `from "${entry}"`));
      const bundle = { bundle: true, format: "esm", target: "es2022", outdir: "site", logLevel: "warning" };
      await esbuild.build({ absWorkingDir: folder, entryPoints: ["main.js"], ...bundle });
      const server = await serve(join(folder, "site"));
      const browser = await launch();
      try {
        const tab = await browser.newPage();
        const errors = [];
        tab.on("pageerror", (error) => errors.push(String(error)));
        await tab.goto(server.url, { waitUntil: "networkidle" });
        // a minimum-jerk movement from between the first two icons to the last; 70% of the way
        for (let k = 0; k <= 28; k++) {
          const u = k / 40;
          const way = 10 * u ** 3 - 15 * u ** 4 + 6 * u ** 5;
          await tab.mouse.move(300 + 748 * way, 600 - 252 * way);
          await tab.waitForTimeout(12);
        }
        assert.deepEqual(await tab.evaluate(() => [...document.querySelectorAll(".next")].map(({ id }) => id)), ["icon3"]);
        assert.deepEqual(errors, []);
      } finally {
        await browser.close();
        await server.close();
      }
    });
  }
});
