// The page itself: sizes, keyboard, theme, reduced motion, a browser that forbids WebAssembly.
import assert from "node:assert/strict";
import { describe, it } from "node:test";
import { build } from "esbuild";
import { movement } from "./hand.mjs";
import { hosted, middles, mouse, open, read, readMovement, REST, serve, sumsToOne } from "./support.mjs";

const IDS = [
  ["navigation", "phone", "radio", "media", "climate", "seats", "camera"],
  ["parking", "drive-mode", "lights", "apps", "messages", "calendar", "weather"],
  ["fuel", "tyres", "trip", "profile", "connections", "settings", "help"],
];

const SIZES = [
  { width: 1280, height: 800, columns: 7 },
  { width: 900, height: 700, columns: 7 },
  { width: 899, height: 700, columns: 3 },
  { width: 390, height: 844, columns: 3 },
  { width: 360, height: 740, columns: 3 },
  { width: 3840, height: 2160, columns: 7 },
];

describe("page", () => {
  const site = hosted();

  const fresh = (options) => open(site.browser, site.url, options);

  for (const { width, height, columns } of SIZES) {
    it(`shows 21 icons in ${columns} columns at ${width} x ${height}, and scrolls nothing sideways`, async () => {
      const { page, problems, close } = await fresh({ viewport: { width, height } });
      const icons = await middles(page);
      assert.deepEqual(
        icons.map((icon) => icon.id),
        IDS.flat(),
      );
      assert.equal(new Set(icons.map((icon) => Math.round(icon.x))).size, columns);
      for (const icon of icons) assert.ok(icon.width >= 44 && icon.height >= 44, `${icon.id} is ${icon.width} x ${icon.height}`);
      assert.ok((await page.evaluate(() => document.documentElement.scrollWidth)) <= width);
      assert.ok((await page.locator("#screen").boundingBox()).width <= 1600);
      assert.deepEqual(problems, []);
      await close();
    });
  }

  it("gives every icon the same probability before anything moves", async () => {
    const { page, close } = await fresh();
    const { icons, none, sum } = await read(page);
    assert.equal(new Set(icons.map((icon) => icon.probability)).size, 1);
    assert.ok(none > 0);
    assert.ok(Math.abs(sum - 1) < 1e-4);
    assert.ok(icons.every((icon) => !icon.predicted));
    await close();
  });

  it("walks the icons with the arrow keys in reading order, and Enter presses", async () => {
    const { page, problems, close } = await fresh();
    const focused = () => page.evaluate(() => document.activeElement.dataset.destination);
    await page.locator("[data-destination=navigation]").focus();
    for (const id of IDS.flat().slice(1)) {
      await page.keyboard.press("ArrowRight");
      assert.equal(await focused(), id);
    }
    await page.keyboard.press("ArrowRight");
    assert.equal(await focused(), "help");
    await page.keyboard.press("ArrowUp");
    assert.equal(await focused(), "weather");
    await page.keyboard.press("ArrowLeft");
    assert.equal(await focused(), "calendar");
    await page.keyboard.press("Home");
    await page.keyboard.press("ArrowDown");
    assert.equal(await focused(), "parking");
    await page.keyboard.press("Enter");
    assert.equal((await read(page)).status, "Parking pressed, without a movement to predict it from.");
    assert.equal(await page.locator("#median").textContent(), "–");
    assert.deepEqual(problems, []);
    await close();
  });

  it("walks by rows of three on a phone", async () => {
    const { page, close } = await fresh({ viewport: { width: 390, height: 844 } });
    await page.locator("[data-destination=navigation]").focus();
    await page.keyboard.press("ArrowDown");
    assert.equal(await page.evaluate(() => document.activeElement.dataset.destination), "media");
    await close();
  });

  for (const theme of ["dark", "light"]) {
    it(`has a contrast of at least 4.5 to 1 for every text, ${theme}`, async () => {
      const { page, close } = await fresh();
      if (theme === "light") await page.locator("#theme").click();
      await page.locator("summary").click();
      const low = await page.evaluate(contrasts);
      assert.deepEqual(low, []);
      await close();
    });
  }

  it("changes the method, the noise and the points without a message on the console", async () => {
    const { page, problems, close } = await fresh();
    await page.locator("summary").click();
    const methods = await page
      .locator("select[name=method] option")
      .evaluateAll((options) => options.map((option) => option.value));
    assert.ok(methods.includes("pointing") && methods.includes("algorithm1") && methods.includes("pseudoObservation"));
    const hand = await mouse(page);
    const icons = await middles(page);
    const [from, to] = ["fuel", "seats"].map((id) => icons.find((icon) => icon.id === id));
    for (const method of methods) {
      await page.locator("select[name=method]").selectOption(method);
      await page.locator("input[name=noise]").fill("0.5");
      await page.locator("input[name=points]").fill("21");
      await page.evaluate(() => scrollTo(0, 0));
      await hand.play([[0, from.x, from.y]]);
      await hand.rest(REST);
      await hand.play(movement(from, to, to.width, { seed: 4, share: 0.8 }));
      const shown = await readMovement(page);
      assert.ok(sumsToOne(shown), `${method}: ${shown.sum}`);
      assert.equal(shown.top.id, "seats", method);
      assert.match(await page.locator("#remaining").textContent(), /^\d+\.\d\d s$/);
    }
    assert.equal(await page.locator("#announcement").evaluate((status) => status.getAttribute("aria-live")), "polite");
    assert.deepEqual(problems, []);
    await close();
  });

  it("keeps still where motion is to be reduced", async () => {
    const { page, close } = await fresh({ reducedMotion: "reduce" });
    const moving = await page.evaluate(
      () =>
        [...document.querySelectorAll("*")].filter((element) =>
          getComputedStyle(element)
            .transitionDuration.split(", ")
            .some((time) => time !== "0s"),
        ).length,
    );
    assert.equal(moving, 0);
    await close();
  });

  it("shows ten lines of code that run as shown", async () => {
    const { page: shown, close } = await fresh();
    const listing = await shown.locator("#listing").textContent();
    await close();
    assert.equal(listing.split("\n").length, 10);
    const { outputFiles } = await build({
      stdin: { contents: listing, resolveDir: import.meta.dirname },
      bundle: true,
      format: "esm",
      write: false,
    });
    // Whatever page these lines are put into, its policy is not at stake here.
    const page = await site.browser.newPage({ bypassCSP: true });
    await page.goto(site.url);
    await page.setContent('<button id="left">Left</button><button id="right" style="margin-left: 700px">Right</button>');
    const errors = [];
    page.on("pageerror", (error) => errors.push(error.message));
    const logged = page.waitForEvent("console", {
      predicate: async (message) => (await message.args()[0]?.jsonValue())?.probability > 0.9,
    });
    await page.evaluate(
      (url) => import(url),
      `data:text/javascript;base64,${Buffer.from(outputFiles[0].contents).toString("base64")}`,
    );
    const hand = await mouse(page);
    await hand.play(movement({ x: 40, y: 300 }, { x: 780, y: 18 }, 40, { seed: 1 }));
    assert.equal((await (await logged).args()[0].jsonValue()).id, "right");
    assert.deepEqual(errors, []);
    await page.close();
  });

  it("states why it cannot start", async () => {
    const strict = await serve("default-src 'none'; script-src 'self'; style-src 'self'; font-src 'self'; img-src 'self'");
    const { page, close } = await open(site.browser, strict.url);
    assert.match((await read(page)).status, /^This page could not start: .*wasm-unsafe-eval/);
    await close();
    await strict.close();
  });
});

/** Runs in the page: every text with less contrast than 4.5 to 1 against what is painted behind it. */
function contrasts() {
  const canvas = document.createElement("canvas").getContext("2d", { willReadFrequently: true });
  const rgb = (colour) => {
    canvas.clearRect(0, 0, 1, 1);
    canvas.fillStyle = colour;
    canvas.fillRect(0, 0, 1, 1);
    return [...canvas.getImageData(0, 0, 1, 1).data];
  };
  const luminance = ([red, green, blue]) => {
    const linear = [red, green, blue].map((part) =>
      part / 255 <= 0.04045 ? part / 255 / 12.92 : ((part / 255 + 0.055) / 1.055) ** 2.4,
    );
    return 0.2126 * linear[0] + 0.7152 * linear[1] + 0.0722 * linear[2];
  };
  const ground = (element) => {
    for (let at = element; at; at = at.parentElement) {
      const colour = rgb(getComputedStyle(at).backgroundColor);
      if (colour[3] === 255) return colour;
    }
    return rgb("white");
  };
  const low = [];
  for (const element of document.querySelectorAll("body *")) {
    const own = [...element.childNodes].some((node) => node.nodeType === Node.TEXT_NODE && node.textContent.trim());
    if (!own || !element.checkVisibility({ opacityProperty: true, visibilityProperty: true })) continue;
    const style = getComputedStyle(element);
    const text = luminance(rgb(element instanceof SVGElement ? style.fill : style.color));
    const behind = luminance(ground(element));
    const contrast = (Math.max(text, behind) + 0.05) / (Math.min(text, behind) + 0.05);
    if (contrast < 4.5) low.push(`${element.textContent.trim().slice(0, 30)}: ${contrast.toFixed(2)}`);
  }
  return low;
}
