// What holds for every page of the demo: how it loads and looks at any size, with large text, without a network, for everybody.
import assert from "node:assert/strict";
import { readFileSync } from "node:fs";
import { mkdtemp, rm, writeFile } from "node:fs/promises";
import { createRequire } from "node:module";
import { tmpdir } from "node:os";
import { join } from "node:path";
import { describe, it } from "node:test";
import { gzipSync } from "node:zlib";
import { capture } from "../../scripts/run.mjs";
import { collisions } from "./collisions.mjs";
import { SCENES } from "./scenes.mjs";
import { hosted, isReady, nextFrame, open, POLICY, shifts } from "./support.mjs";

const axe = readFileSync(createRequire(import.meta.url).resolve("axe-core/axe.min.js"), "utf8");

const DESKTOP = { width: 1280, height: 800 };
const SIZES = [DESKTOP, { width: 390, height: 844 }, { width: 360, height: 640 }];

const sum = (moved) => moved.reduce((total, { value }) => total + value, 0);

/** Every text and number is on the page, and nothing is folded. */
async function unfolded(page, fill) {
  await fill(page);
  await page.evaluate(() => document.querySelectorAll("details").forEach((details) => (details.open = true)));
}

const lightness = async (page) => {
  const ground = await page.evaluate(() => getComputedStyle(document.documentElement).backgroundColor);
  return (
    ground
      .match(/\d+/g)
      .map(Number)
      .slice(0, 3)
      .reduce((total, part) => total + part, 0) / 3
  );
};

for (const { path, name, fill } of SCENES) {
  describe(`page: ${name}`, () => {
    const site = hosted();
    const fresh = (options) => open(site.browser, site.url, options, path);

    for (const viewport of SIZES) {
      it(`shifts nothing over a slow line and while numbers come, at ${viewport.width} px`, async () => {
        const { page, close } = await fresh({ viewport });
        const session = await page.context().newCDPSession(page);
        await session.send("Network.setCacheDisabled", { cacheDisabled: true });
        await session.send("Network.emulateNetworkConditions", {
          offline: false,
          latency: 100,
          downloadThroughput: 400_000,
          uploadThroughput: 100_000,
        });
        await page.reload();
        await page.waitForFunction(isReady);
        await fill(page);
        const moved = await shifts(page);
        await close();
        assert.ok(sum(moved) < 0.01, JSON.stringify(moved));
      });
    }

    for (const width of [1920, 1280, 900, 390, 360]) {
      it(`has no text over another, cut or outside, as it is and at 200%, at ${width} px`, async () => {
        const { page, problems, close } = await fresh({ viewport: { width, height: 800 } });
        await unfolded(page, fill);
        assert.deepEqual(await page.evaluate(collisions), []);
        await page.evaluate(() => (document.documentElement.style.fontSize = "200%"));
        await nextFrame(page);
        assert.deepEqual(await page.evaluate(collisions), []);
        assert.deepEqual(problems, []);
        await close();
      });
    }

    it("fills a screen of 3840 px", async () => {
      const { page, close } = await fresh({ viewport: { width: 3840, height: 2160 } });
      const { width, text } = await page.evaluate(() => ({
        width: document.querySelector("main").getBoundingClientRect().width,
        text: Number.parseFloat(getComputedStyle(document.body).fontSize),
      }));
      assert.ok(width > 2000 && text >= 22, `${width} px wide, text of ${text} px`);
      await close();
    });

    for (const colorScheme of ["dark", "light"]) {
      it(`keeps nobody from using it, ${colorScheme} (axe)`, async () => {
        const { page, close } = await fresh({ colorScheme });
        await unfolded(page, fill);
        await page.evaluate(axe);
        const { violations, passes } = await page.evaluate(async () => {
          const found = await window.axe.run(document, { resultTypes: ["violations"] });
          return {
            passes: found.passes.length,
            violations: found.violations.map(({ id, nodes }) => `${id}: ${nodes.map(({ html }) => html.slice(0, 120))}`),
          };
        });
        await close();
        assert.deepEqual(violations, []);
        assert.ok(passes > 20);
      });
    }

    it("has the theme that was chosen, else the system's, before its own scripts run", async () => {
      const { page, close } = await fresh({ colorScheme: "light" });
      assert.ok((await lightness(page)) > 200);
      await page.emulateMedia({ colorScheme: "dark" });
      await page.waitForFunction(() => document.documentElement.dataset.theme === "dark");
      assert.ok((await lightness(page)) < 40);
      await page.locator("#theme").click();
      assert.equal(await page.locator("#theme").getAttribute("aria-pressed"), "true");
      let release;
      const held = new Promise((resolve) => (release = resolve));
      await page.route("**/assets/*.js", async (route) => {
        await held;
        await route.continue();
      });
      await page.reload({ waitUntil: "commit" });
      await page.waitForFunction(() => performance.getEntriesByName("first-contentful-paint").length > 0);
      assert.ok((await lightness(page)) > 200);
      assert.equal(await page.evaluate(isReady), false);
      release();
      await page.waitForFunction(isReady);
      await close();
    });

    it("keeps still where motion is to be reduced", async () => {
      const { page, close } = await fresh({ reducedMotion: "reduce" });
      const before = await page.screenshot();
      await page.waitForTimeout(1500);
      assert.ok(before.equals(await page.screenshot()));
      await close();
    });

    it("is legible in the system's own colours", async () => {
      const { page, problems, close } = await fresh({ forcedColors: "active" });
      await fill(page);
      const { ground, text, controls } = await page.evaluate(() => {
        const style = (element) => getComputedStyle(element);
        return {
          ground: style(document.documentElement).backgroundColor,
          text: style(document.body).color,
          controls: [...document.querySelectorAll("main button, main canvas")]
            .filter((element) => element.checkVisibility())
            .map((element) => style(element).color),
        };
      });
      assert.notEqual(text, ground);
      for (const colour of controls) assert.notEqual(colour, ground);
      assert.deepEqual(problems, []);
      await close();
    });

    it("reaches every other page, at 360 px too, and they lead back", async () => {
      const { page, problems, close } = await fresh({ viewport: { width: 360, height: 740 } });
      const links = page.locator(".links a");
      assert.equal(await links.count(), SCENES.length);
      for (const link of await links.all()) {
        const { x, width, height } = await link.boundingBox();
        assert.ok(x >= 0 && x + width <= 360 && height >= 44, `${await link.textContent()}: ${[x, width, height]}`);
      }
      for (const other of SCENES.filter((scene) => scene.path !== path)) {
        await page.locator(".links").getByRole("link", { name: other.name, exact: true }).click();
        await page.waitForURL(site.url + other.path);
        await page.waitForFunction(isReady);
        await page.locator(".links").getByRole("link", { name, exact: true }).click();
        await page.waitForURL(site.url + path);
        await page.waitForFunction(isReady);
      }
      assert.deepEqual(problems, []);
      await close();
    });

    it("names every control", async () => {
      const { page, close } = await fresh();
      await unfolded(page, fill);
      for (const role of ["slider", "combobox", "button", "checkbox", "link", "spinbutton", "radio"]) {
        for (const control of await page.getByRole(role).all()) {
          const [line] = (await control.ariaSnapshot()).split("\n");
          assert.match(line, new RegExp(`${role} ".+"`), line);
        }
      }
      await close();
    });
  });
}

describe("without a network", () => {
  const site = hosted(`${POLICY}; connect-src 'self'`);

  it("every page works once one of them has been visited", async () => {
    const { page, close } = await open(site.browser, site.url, { keeps: true });
    await page.evaluate(() => navigator.serviceWorker.ready);
    await page.context().setOffline(true);
    for (const path of ["", ...SCENES.map((scene) => scene.path)]) {
      await page.goto(site.url + path);
      await page.waitForFunction(isReady);
      assert.equal(await page.evaluate(() => document.documentElement.dataset.failed), undefined, path);
    }
    await close();
  });
});

describe("beside the pages", () => {
  const site = hosted();

  it("lies the package, which the line on the first page installs", async (test) => {
    const { page, close } = await open(site.browser, site.url);
    const [line] = (await page.locator("body").textContent()).match(/npm install \S+whither\.tgz/);
    await close();
    const folder = await mkdtemp(join(tmpdir(), "whither-install-"));
    test.after(() => rm(folder, { recursive: true }));
    await writeFile(join(folder, "package.json"), "{}");
    const installed = await capture("npm", [...line.split(" ").slice(1), "--no-audit", "--no-fund"], { cwd: folder });
    assert.equal(installed.code, 0, installed.output);
    const program = `import { init, PointerPredictor } from "whither/pointing"; await init(); console.log(new PointerPredictor([]).none);`;
    const { output } = await capture("node", ["--input-type=module", "--eval", program], { cwd: folder });
    assert.equal(output.trim(), "1");
  });

  it("are the notices of all that is bundled", async () => {
    const text = await (await fetch(`${site.url}licences.md`)).text();
    for (const name of ["lucide", "twgl.js", "uplot", "js.foresight", "@fontsource-variable/archivo"])
      assert.match(text, new RegExp(`^## ${name} - \\d`, "m"));
  });
});

describe("the way to the first frame", () => {
  const site = hosted();

  it("of the car's screen is at most 150 kB under gzip, its typeface included", async (test) => {
    const context = await site.browser.newContext({ viewport: DESKTOP });
    const page = await context.newPage();
    const answers = [];
    page.on("response", (response) => answers.push(response));
    await page.goto(site.url);
    await page.waitForFunction(isReady);
    const first = await page.evaluate(() => performance.getEntriesByName("icons")[0].startTime);
    const times = await page.evaluate(() =>
      [...performance.getEntriesByType("navigation"), ...performance.getEntriesByType("resource")].map((entry) => [
        entry.name,
        entry.startTime,
      ]),
    );
    const before = new Set(times.filter(([, time]) => time <= first).map(([name]) => name));
    let total = 0;
    for (const response of answers.filter((answer) => before.has(answer.url()))) {
      const body = await response.body();
      const size = response.url().endsWith(".woff2") ? body.length : gzipSync(body).length;
      test.diagnostic(`${(size / 1000).toFixed(1)} kB ${new URL(response.url()).pathname}`);
      total += size;
    }
    await context.close();
    test.diagnostic(`${(total / 1000).toFixed(1)} kB in all`);
    assert.ok(before.size > 3 && total <= 150_000, `${total} bytes`);
  });
});
