// How the page looks to whoever comes: before the first paint, while it loads, with large text, with the system's own colours.
import assert from "node:assert/strict";
import { describe, it } from "node:test";
import { head, hosted, mouse, open, shifts } from "./support.mjs";

const PAGE = { path: "", ready: () => document.querySelector("#none").textContent !== "–" };
const SEQUENCES = {
  path: "sequences/index.html",
  ready: () => document.querySelector("#kind").textContent !== "–" || document.documentElement.dataset.failed,
};

describe("look", () => {
  const site = hosted();

  const fresh = (options, where) => open(site.browser, site.url, options, where);

  /** Moves and presses, so that every text and number is there. */
  async function press(page) {
    const hand = await mouse(page);
    const { end } = await head(page, hand, "fuel", "connections", { seed: 5 });
    await hand.press(end);
  }

  for (const [width, height] of [
    [1280, 800],
    [390, 844],
    [360, 740],
  ]) {
    it(`shifts nothing while it loads and while numbers come, at ${width} px`, async () => {
      const { page, close } = await fresh({ viewport: { width, height } });
      await press(page);
      const moved = await shifts(page);
      await close();
      const sum = moved.reduce((total, { value }) => total + value, 0);
      assert.ok(sum < 0.01, JSON.stringify(moved));
    });

    for (const [name, where] of [
      ["page", PAGE],
      ["page of the sequences", SEQUENCES],
    ]) {
      it(`shifts nothing where the ${name} comes over a slow line, at ${width} px`, async () => {
        const { page, close } = await fresh({ viewport: { width, height } }, where);
        const session = await page.context().newCDPSession(page);
        await session.send("Network.setCacheDisabled", { cacheDisabled: true });
        await session.send("Network.emulateNetworkConditions", {
          offline: false,
          latency: 100,
          downloadThroughput: 300_000,
          uploadThroughput: 100_000,
        });
        await page.reload();
        await page.waitForFunction(where.ready);
        const moved = await shifts(page);
        await close();
        const sum = moved.reduce((total, { value }) => total + value, 0);
        assert.ok(sum < 0.01, JSON.stringify(moved));
      });
    }
  }

  describe("theme", () => {
    const ground = (page) => page.evaluate(() => getComputedStyle(document.documentElement).backgroundColor);
    const lightness = async (page) => {
      const [red, green, blue] = (await ground(page)).match(/\d+/g).map(Number);
      return (red + green + blue) / 3;
    };

    it("is the system's where nothing was chosen, and follows it", async () => {
      const { page, problems, close } = await fresh({ colorScheme: "light" });
      assert.ok((await lightness(page)) > 200);
      assert.equal(await page.locator("#theme").getAttribute("aria-pressed"), "true");
      await page.emulateMedia({ colorScheme: "dark" });
      await page.waitForFunction(() => document.documentElement.dataset.theme === "dark");
      assert.ok((await lightness(page)) < 40);
      assert.equal(await page.locator("#theme").getAttribute("aria-pressed"), "false");
      assert.deepEqual(problems, []);
      await close();
    });

    for (const path of ["", "sequences/index.html"]) {
      it(`is the chosen one once something was chosen, before anything else of /${path} runs`, async () => {
        const { page, close } = await fresh({ colorScheme: "dark" }, path ? SEQUENCES : undefined);
        assert.ok((await lightness(page)) < 40);
        await page.locator("#theme").click();
        assert.ok((await lightness(page)) > 200);
        let release;
        const held = new Promise((resolve) => (release = resolve));
        await page.route("**/assets/*.js", async (route) => {
          await held;
          await route.continue();
        });
        await page.reload({ waitUntil: "commit" });
        await page.waitForFunction(() => performance.getEntriesByName("first-contentful-paint").length > 0);
        assert.ok((await lightness(page)) > 200);
        assert.equal(await page.locator("button[data-destination]").count(), 0);
        release();
        await page.waitForLoadState();
        await close();
      });
    }
  });

  describe("large text", () => {
    for (const [width, height] of [
      [1920, 1080],
      [1280, 800],
      [900, 700],
      [390, 844],
      [360, 740],
    ]) {
      for (const [name, where] of [
        ["page", undefined],
        ["page of the sequences", SEQUENCES],
      ]) {
        it(`collides nowhere and is cut nowhere at 200%, ${width} px, on the ${name}`, async () => {
          const { page, problems, close } = await fresh({ viewport: { width, height } }, where);
          await page.evaluate(() => (document.documentElement.style.fontSize = "200%"));
          if (!where) await press(page);
          assert.deepEqual(await page.evaluate(collisions), []);
          assert.deepEqual(problems, []);
          await close();
        });
      }
    }

    for (const width of [1280, 390, 360]) {
      it(`neither does text of the usual size, at ${width} px`, async () => {
        const { page, close } = await fresh({ viewport: { width, height: 800 } });
        await press(page);
        assert.deepEqual(await page.evaluate(collisions), []);
        await close();
      });
    }
  });

  it("keeps bars and ring in the system's own colours", async () => {
    const { page, problems, close } = await fresh({ forcedColors: "active" });
    const { shown } = await head(page, await mouse(page), "fuel", "seats", { seed: 5 });
    assert.ok(shown.icons.some((icon) => icon.predicted));
    const { ground, text, bar, rail, outline, ring, fan } = await page.evaluate(() => {
      const of = (selector, pseudo) => getComputedStyle(document.querySelector(selector), pseudo);
      const rail = of(".row-bar");
      return {
        ground: of("html").backgroundColor,
        text: of("body").color,
        bar: of(".row-bar", "::before").backgroundColor,
        rail: rail.backgroundColor,
        outline: `${rail.outlineStyle} ${rail.outlineColor}`,
        ring: of("[data-predicted=true] .ring circle").stroke,
        fan: of(".fan").color,
      };
    });
    assert.equal(rail, ground);
    assert.equal(outline, `solid ${text}`);
    for (const colour of [bar, ring, fan]) assert.notEqual(colour, ground);
    assert.deepEqual(problems, []);
    await close();
  });

  it("shows an example on the idle chart, with nothing cut off, and labels it as one", async () => {
    const { page, problems, close } = await fresh({ reducedMotion: "reduce" });
    assert.match(
      await page.locator("#lead").textContent(),
      /^An example, until you move\. Seats: right \d+ ms before the press$/,
    );
    const edges = await page.evaluate(() => {
      const canvas = document.querySelector("#chart canvas");
      const { width, height } = canvas;
      const { data } = canvas.getContext("2d").getImageData(0, 0, width, height);
      const found = { all: 0, rims: 0 };
      for (let y = 0; y < height; y += 1) {
        for (let x = 0; x < width; x += 1) {
          if (data[4 * (y * width + x) + 3] === 0) continue;
          found.all += 1;
          if (x === 0 || y === 0 || x === width - 1 || y === height - 1) found.rims += 1;
        }
      }
      return found;
    });
    assert.ok(edges.all > 10_000);
    assert.equal(edges.rims, 0);
    await head(page, await mouse(page), "fuel", "seats", { seed: 5 });
    assert.equal(await page.locator("#chart[data-example]").count(), 0);
    assert.equal(await page.locator("#lead").textContent(), "Under way");
    assert.deepEqual(problems, []);
    await close();
  });

  for (const width of [899, 390, 360]) {
    it(`has its links within reach at ${width} px`, async () => {
      for (const where of [undefined, SEQUENCES]) {
        const { page, close } = await fresh({ viewport: { width, height: 740 } }, where);
        const links = await page.locator(".links a").all();
        assert.ok(links.length >= 2);
        for (const link of links) {
          const {
            x,
            y,
            width: wide,
            height,
          } = (await link.boundingBox()) ?? assert.fail(`${await link.textContent()} has no box`);
          assert.ok(x >= 0 && x + wide <= width && height >= 44, `${await link.textContent()}: ${[x, y, wide, height]}`);
        }
        await links.at(-1).click();
        await page.waitForURL(where ? /#what$/ : /sequences\/index\.html$/);
        await close();
      }
    });
  }

  it("names every slider after what it sets, and gives its value as it is meant", async () => {
    const named = async (page) => {
      const found = [];
      for (const slider of await page.getByRole("slider").all())
        found.push(/slider "([^"]+)"/.exec(await slider.ariaSnapshot())?.[1] ?? "");
      return found;
    };
    const first = await fresh();
    await first.page.locator("summary").click();
    assert.deepEqual(await named(first.page), ["Noise of the hand", "Quadrature points", "The ring closes at"]);
    assert.equal(await first.page.getByLabel("The ring closes at").getAttribute("aria-valuetext"), "80%");
    assert.equal(await first.page.getByRole("combobox", { name: "Method" }).count(), 1);
    await first.close();
    const second = await fresh({}, SEQUENCES);
    assert.deepEqual(await named(second.page), [
      "Measurements so far",
      "Process noise, q (m²/s³)",
      "Spread of the origin, one deviation",
      "Spread of the destination, one deviation",
      "Correlation of origin and destination",
    ]);
    await second.close();
  });
});

/** Runs in the page: texts that lie over one another or outside of what shows them, and what scrolls sideways. */
function collisions() {
  const found = [];
  if (document.documentElement.scrollWidth > innerWidth)
    found.push(`the page is ${document.documentElement.scrollWidth} px wide`);
  const texts = [];
  for (const element of document.querySelectorAll("body *")) {
    if (element.closest(".hidden, .skip, svg, select, details:not([open]) > :not(summary)")) continue;
    if (!element.checkVisibility({ opacityProperty: true, visibilityProperty: true })) continue;
    if (getComputedStyle(element).clipPath !== "none") continue; // for screen readers alone
    for (const node of element.childNodes) {
      if (node.nodeType !== Node.TEXT_NODE || !node.textContent.trim()) continue;
      const range = document.createRange();
      range.selectNodeContents(node);
      for (const box of range.getClientRects()) texts.push({ element, box, text: node.textContent.trim().slice(0, 30) });
    }
    const own = [...element.childNodes].some((node) => node.nodeType === Node.TEXT_NODE && node.textContent.trim());
    if (own && ["hidden", "clip"].includes(getComputedStyle(element).overflowX) && element.scrollWidth > element.clientWidth + 1)
      found.push(`cut: ${element.textContent.trim().slice(0, 30)}`);
  }
  const over = (a, b) =>
    Math.min(a.right, b.right) - Math.max(a.left, b.left) > 1 && Math.min(a.bottom, b.bottom) - Math.max(a.top, b.top) > 1;
  texts.forEach(({ element, box, text }, index) => {
    // the height of the letters, not that of the line
    const letters = (rect) => ({
      left: rect.left,
      right: rect.right,
      top: rect.top + 0.2 * rect.height,
      bottom: rect.bottom - 0.2 * rect.height,
    });
    for (const other of texts.slice(index + 1)) {
      if (other.element !== element && over(letters(box), letters(other.box))) found.push(`${text} over ${other.text}`);
    }
    const inside = element.closest("button")?.getBoundingClientRect();
    if (inside && (box.left < inside.left - 1 || box.right > inside.right + 1 || box.bottom > inside.bottom + 1))
      found.push(`${text} is outside its button`);
    if (!element.closest("pre") && (box.right > innerWidth + 1 || box.left < -1)) found.push(`${text} is outside the page`);
  });
  return found;
}
