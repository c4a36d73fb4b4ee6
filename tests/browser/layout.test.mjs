// Where icons and pixels change without an event for it: a transform on an ancestor, another resolution.
import assert from "node:assert/strict";
import { describe, it } from "node:test";
import { head, hosted, mouse, nextFrame, open } from "./support.mjs";

/** Styles that move the icons after the page has loaded, and resize nothing. */
const MOVES = [
  ["a shift of the icons", "#grid", "transform: translate(-90px, 40px)"],
  ["a page made smaller", "main", "transform: scale(0.6); transform-origin: 0 0"],
  ["a page turned upside down", "#screen", "rotate: 180deg"],
];

const canvases = (page) =>
  page.evaluate(() =>
    [...document.querySelectorAll("canvas")].map((canvas) => canvas.width / Math.max(1, canvas.getBoundingClientRect().width)),
  );

describe("layout", () => {
  const site = hosted();

  for (const [name, selector, style] of MOVES) {
    it(`follows ${name}`, async () => {
      const { page, problems, close } = await open(site.browser, site.url);
      await page.evaluate(([selector, style]) => (document.querySelector(selector).style.cssText += style), [selector, style]);
      const hand = await mouse(page);
      for (const [from, to] of [
        ["media", "tyres"],
        ["fuel", "navigation"],
        ["help", "phone"],
      ]) {
        const { shown } = await head(page, hand, from, to, { seed: 7, share: 0.85 });
        assert.equal(shown.top.id, to, `from ${from}`);
      }
      assert.deepEqual(problems, []);
      await close();
    });
  }

  it("begins again where the method accumulates and the icons have moved", async () => {
    const { page, problems, close } = await open(site.browser, site.url);
    await page.locator(".controls summary").click();
    await page.locator("select[name=method]").selectOption("algorithm1");
    const hand = await mouse(page);
    await head(page, hand, "media", "tyres", { seed: 3, share: 0.5 });
    await page.evaluate(() => (document.querySelector("#grid").style.transform = "translate(-60px, 30px)"));
    const { shown } = await head(page, hand, "fuel", "navigation", { seed: 4, share: 0.9 });
    assert.equal(shown.top.id, "navigation");
    assert.deepEqual(problems, []);
    await close();
  });

  for (const path of ["index.html", "sequences/index.html"]) {
    it(`draws as finely as the screen shows, on /${path}`, async () => {
      const { page, problems, close } = await open(site.browser, site.url, {}, path);
      const session = await page.context().newCDPSession(page);
      for (const [step, deviceScaleFactor] of [2, 1.5, 1].entries()) {
        // Chromium reports an emulated resolution to the page only together with another size; this one resizes nothing on it
        const size = { width: 1280, height: 801 + step };
        await session.send("Emulation.setDeviceMetricsOverride", { ...size, deviceScaleFactor, mobile: false });
        await nextFrame(page);
        await page.waitForFunction((ratio) => devicePixelRatio === ratio, deviceScaleFactor);
        await nextFrame(page);
        const found = await canvases(page);
        assert.ok(
          found.length > 0 && found.every((ratio) => Math.abs(ratio - deviceScaleFactor) < 0.02),
          `${deviceScaleFactor}: ${found}`,
        );
      }
      assert.deepEqual(problems, []);
      await close();
    });
  }
});
