// How the car's screen looks before anybody has moved, and with the system's own colours.
import assert from "node:assert/strict";
import { describe, it } from "node:test";
import { head, hosted, mouse, open } from "./support.mjs";

describe("look", () => {
  const site = hosted();

  const fresh = (options) => open(site.browser, site.url, options);

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
    assert.equal(await page.locator("#lead").textContent(), "An example, until you move");
    assert.match(await page.locator("#chart").getAttribute("aria-label"), /: Seats lit 0\.\d\d s before the press$/);
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

  it("names every slider after what it sets, and gives its value as it is meant", async () => {
    const named = async (page) => {
      const found = [];
      for (const slider of await page.getByRole("slider").all())
        found.push(/slider "([^"]+)"/.exec(await slider.ariaSnapshot())?.[1] ?? "");
      return found;
    };
    const first = await fresh();
    await first.page.locator("summary").click();
    assert.deepEqual(await named(first.page), [
      "The road shakes it by",
      "As often as",
      "Noise of the hand",
      "Quadrature points",
      "To none of them, before it is observed",
      "The ring closes at",
    ]);
    assert.equal(await first.page.getByLabel("The ring closes at").getAttribute("aria-valuetext"), "80%");
    assert.equal(await first.page.getByRole("combobox", { name: "Method", exact: true }).count(), 1);
    await first.close();
  });
});
