// A finger on a phone: it scrolls the page, a tap presses, and sideways it points.
import assert from "node:assert/strict";
import { describe, it } from "node:test";
import { drag, hosted, middles, open, read, sumsToOne } from "./support.mjs";

const PHONE = { viewport: { width: 390, height: 844 }, hasTouch: true, isMobile: true };

describe("touch", () => {
  const site = hosted();

  const fresh = () => open(site.browser, site.url, PHONE);

  /** What a press would have changed. */
  const presses = (page) =>
    page.evaluate(() => ({
      pressed: document.querySelectorAll("[data-pressed]").length,
      median: document.querySelector("#median").textContent,
    }));

  /** A finger from one place to another, in steps of 16 ms. */
  const line = (from, to, seconds) =>
    Array.from({ length: Math.round(seconds / 0.016) + 1 }, (_, step, share = (step * 0.016) / seconds) => [
      step * 0.016,
      from.x + share * (to.x - from.x),
      from.y + share * (to.y - from.y),
    ]);

  it("scrolls the page with a swipe over the icons, and presses none of them", async () => {
    const { page, problems, close } = await fresh();
    const icons = await middles(page);
    const [from, to] = ["fuel", "climate"].map((id) => icons.find((icon) => icon.id === id));
    await drag(page, line(from, { x: from.x, y: to.y }, 0.3));
    await page.waitForFunction(() => scrollY > 100);
    assert.deepEqual(await presses(page), { pressed: 0, median: "–" });
    const shown = await read(page);
    assert.ok(shown.icons.every((icon) => !icon.predicted));
    assert.equal(shown.status, "Draw a finger sideways, towards an icon.");
    assert.deepEqual(problems, []);
    await close();
  });

  it("predicts a finger that is drawn sideways, and takes its lifting for no press", async () => {
    const { page, problems, close } = await fresh();
    const icons = await middles(page);
    const [from, to] = ["lights", "messages"].map((id) => icons.find((icon) => icon.id === id));
    let shown;
    await drag(page, line(from, to, 0.4), async () => {
      // a busy page may take in the last samples later
      const arrived = await page.waitForFunction(() => {
        const now = window.shown();
        return now.top?.id === "messages" && now;
      });
      shown = await arrived.jsonValue();
    });
    assert.ok(sumsToOne(shown), `${shown.sum}`);
    assert.equal(await page.evaluate(() => scrollY), 0);
    assert.deepEqual(await presses(page), { pressed: 0, median: "–" });
    assert.deepEqual(problems, []);
    await close();
  });

  it("selects where a finger lifts on a road, which shakes it", async () => {
    const { page, problems, close } = await fresh();
    await page.locator(".controls summary").click();
    await page.locator("#amplitude").fill("6");
    await page.evaluate(() => {
      scrollTo(0, 0);
      window.types = new Set();
      addEventListener("pointermove", ({ pointerType }) => window.types.add(pointerType));
    });
    const icons = await middles(page);
    const [from, to] = ["lights", "messages"].map((id) => icons.find((icon) => icon.id === id));
    await drag(page, line(from, to, 0.4), async () => {
      await page.waitForFunction(() => window.types.has("shaken") && !document.querySelector("#hand").hidden);
    });
    await page.waitForFunction(() => document.querySelector("#lead").textContent === "Yours, to Messages");
    assert.equal(await page.locator("#hand").isHidden(), true);
    assert.equal(await page.evaluate(() => scrollY), 0);
    assert.deepEqual(problems, []);
    await close();
  });

  it("presses with a tap", async () => {
    const { page, problems, close } = await fresh();
    const { x, y } = (await middles(page)).find((icon) => icon.id === "media");
    await page.touchscreen.tap(x, y);
    assert.equal((await read(page)).status, "Media pressed, without a movement to predict it from.");
    assert.deepEqual(await presses(page), { pressed: 1, median: "–" });
    assert.deepEqual(problems, []);
    await close();
  });
});
