// The programs of docs/testing.md with the test runners and browsers' drivers that they are for.
import { test } from "node:test";
import assert from "node:assert/strict";
import { mkdirSync, readFileSync } from "node:fs";
import { join } from "node:path";
import { transform } from "esbuild";
import { pathOfChromium } from "../../scripts/chromium.mjs";
import { capture, root } from "../../scripts/run.mjs";
import { serve } from "../../scripts/serve.mjs";
import { write } from "../package/support.mjs";

const text = readFileSync(join(root, "docs/testing.md"), "utf8");

/** The one program of a language that has this in it. */
function program(language, containing) {
  const programs = [...text.matchAll(new RegExp(`^\`\`\`${language}\\n(.*?)^\`\`\``, "gms"))].map(([, program]) => program);
  const found = programs.filter((each) => each.includes(containing));
  assert.equal(found.length, 1, containing);
  return found[0];
}

/** A page whose link is fetched when it is meant. */
const page = `<!doctype html><html lang="en"><meta charset="utf-8"><title>A shop</title><link rel="icon" href="data:,">
<a href="prices.html" style="position: absolute; left: 700px; top: 80px; width: 90px; height: 40px">Prices</a>
<button style="position: absolute; left: 200px; top: 60px; width: 90px; height: 40px">Menu</button>
<script type="module">
  import { watch } from "./node_modules/whither/dist/dom.js";
  const watcher = watch("a", { load: "eager", onIntent: ({ target, signal }) => fetch(target.href, { signal }) });
  document.querySelector("button").addEventListener("click", () => (document.title = "pressed"));
  await watcher.ready;
  document.body.dataset.ready = "";
</script></html>`;

/** Runs them in a folder that has them, and the package, installed. */
export function testRunners(folder) {
  const inFolder = (...path) => join(folder, ...path);
  const runs = async (args, env) => {
    const { code, output } = await capture("node", args, { cwd: folder, env });
    assert.equal(code, 0, output);
    return output;
  };

  test("whither/testing in Jest with jsdom and fake timers", async () => {
    const vitest = program("ts", 'from "vitest"');
    const jest = vitest.replace('vi } from "vitest"', 'jest } from "@jest/globals"').replaceAll("vi.", "jest.");
    const { code } = await transform(jest, { loader: "ts" });
    mkdirSync(inFolder("jest"), { recursive: true });
    write(inFolder("jest"), "page.test.js", code);
    write(inFolder("jest"), "environment.mjs", program("js", "jest-environment-jsdom"));
    const args = ["--rootDir", "jest", "--env", "./environment.mjs", "--config", "{}"];
    const output = await runs(["node_modules/jest/bin/jest.js", ...args], { NODE_OPTIONS: "--experimental-vm-modules" });
    assert.match(output, /Tests:\s+1 passed/);
  });

  test("whither/testing by the browser's mouse", async (t) => {
    write(folder, "index.html", page);
    write(folder, "prices.html", "<!doctype html>");
    const host = await serve(folder);
    t.after(() => host.close());
    const path = await pathOfChromium();

    await t.test("of Playwright", async () => {
      mkdirSync(inFolder("playwright"), { recursive: true });
      write(
        inFolder("playwright"),
        "page.spec.ts",
        program("ts", 'from "@playwright/test"').replaceAll('goto("/")', `goto("${host.url}")`),
      );
      const launchOptions = { executablePath: path, args: ["--no-sandbox"] };
      const config = { testDir: ".", workers: 1, use: { launchOptions } };
      write(inFolder("playwright"), "playwright.config.mjs", `export default ${JSON.stringify(config)};`);
      const output = await runs(["node_modules/@playwright/test/cli.js", "test", "--config", "playwright", "--reporter", "list"]);
      assert.match(output, /2 passed/);
    });

    await t.test("of Puppeteer", async () => {
      const [imports, ...rest] = program("ts", "page.waitForSelector").split("\n\n");
      write(
        folder,
        "puppeteer.mjs",
        `${imports}
        import puppeteer from "puppeteer-core";
        const browser = await puppeteer.launch({ executablePath: ${JSON.stringify(path)}, args: ["--no-sandbox"] });
        const page = await browser.newPage();
        await page.setViewport({ width: 1000, height: 700 });
        await page.goto(${JSON.stringify(host.url)});
        ${rest.join("\n\n")}
        console.log(await page.title());
        await browser.close();`,
      );
      assert.equal((await runs(["puppeteer.mjs"])).trim(), "pressed");
    });
  });
}
