// The ghost, on a clock that the test moves.
import assert from "node:assert/strict";
import { describe, it } from "node:test";
import { hosted } from "./support.mjs";

describe("ghost", () => {
  const site = hosted();

  /** A page whose clock is stopped unless `page.clock.runFor` moves it. */
  async function fresh(options) {
    const context = await site.browser.newContext({ viewport: { width: 1280, height: 800 }, ...options });
    const page = await context.newPage();
    await page.clock.install({ time: 0 });
    await page.clock.pauseAt(1000);
    await page.goto(site.url);
    await page.waitForFunction(() => document.querySelector("#none").textContent !== "–", null, { polling: 50 });
    return { page, visible: () => page.locator("#ghost").isVisible(), close: () => context.close() };
  }

  it("comes after a second, goes at the first input, and comes back after a while without input", async () => {
    const { page, visible, close } = await fresh();
    await page.clock.runFor(700);
    assert.equal(await visible(), false);
    await page.clock.runFor(700);
    assert.equal(await visible(), true);
    await page.clock.runFor(4000);
    assert.match(await page.locator("#lead").textContent(), /^A simulated hand\b/);
    assert.match(await page.locator("#status").textContent(), /^A simulated hand\./);
    assert.equal(await page.locator("#median").textContent(), "–");
    await page.mouse.move(600, 300);
    assert.equal(await visible(), false);
    await page.clock.runFor(10_000);
    assert.equal(await visible(), false);
    await page.clock.runFor(8000);
    assert.equal(await visible(), true);
    await close();
  });

  for (const viewport of [
    { width: 1280, height: 800 },
    { width: 390, height: 844 },
  ]) {
    it(`lights something most of the time, moves slowly, and hides no icon that it presses, at ${viewport.width} px`, async () => {
      const { page, close } = await fresh({ viewport });
      await page.clock.runFor(1200);
      await page.evaluate(() => {
        window.counted = { frames: 0, lit: 0, ringed: 0, hidden: [], fastest: 0, trails: 0, presses: 0 };
        const arrow = document.querySelector("#ghost .arrow");
        let last = null;
        const watch = (now) => {
          const icons = [...document.querySelectorAll("button[data-destination]")];
          const { counted } = window;
          counted.frames += 1;
          if (icons.some((icon) => Number(icon.style.getPropertyValue("--light-share")) > 0.3)) counted.lit += 1;
          if (icons.some((icon) => icon.matches("[data-predicted], [data-held]"))) counted.ringed += 1;
          if (document.querySelector("#ghost .trail").getAttribute("d")) counted.trails += 1;
          const at = arrow.getBoundingClientRect();
          if (last)
            counted.fastest = Math.max(
              counted.fastest,
              (1000 * Math.hypot(at.left - last.left, at.top - last.top)) / (now - last.now),
            );
          last = { now, left: at.left, top: at.top };
          requestAnimationFrame(watch);
        };
        requestAnimationFrame(watch);
        new MutationObserver((records) => {
          const icon = records.find(({ target }) => target.hasAttribute("data-pressed"))?.target;
          if (!icon) return;
          window.counted.presses += 1;
          const [at, glyph] = [arrow, icon.querySelector(".glyph")].map((element) => element.getBoundingClientRect());
          if (at.left < glyph.right && at.right > glyph.left && at.top < glyph.bottom && at.bottom > glyph.top)
            window.counted.hidden.push(icon.dataset.destination);
        }).observe(document.querySelector("#grid"), { subtree: true, attributeFilter: ["data-pressed"] });
      });
      // long enough that what a busy machine loses at the beginning does not count
      await page.clock.runFor(30_000);
      const { frames, lit, ringed, hidden, fastest, trails, presses } = await page.evaluate(() => window.counted);
      await close();
      assert.ok(frames > 500, `${frames} frames`);
      assert.ok(lit > 0.6 * frames, `lit in ${lit} of ${frames} frames`);
      assert.ok(ringed > 0.3 * frames, `ringed in ${ringed} of ${frames} frames`);
      assert.ok(trails > 0.3 * frames, `a trail in ${trails} of ${frames} frames`);
      assert.ok(fastest < 1700, `${Math.round(fastest)} px/s`);
      assert.ok(presses >= 3, `${presses} presses`);
      assert.deepEqual(hidden, []);
    });
  }

  it("is shaken by the road, as the visitor is", async () => {
    const rough = [];
    for (const amplitude of ["0", "20"]) {
      const { page, close } = await fresh();
      await page.locator(".controls summary").click();
      await page.locator("#amplitude").fill(amplitude);
      await page.evaluate(() => {
        scrollTo(0, 0);
        window.path = [];
        addEventListener("pointermove", ({ pointerType, clientY }) => pointerType === "ghost" && window.path.push(clientY));
      });
      await page.clock.runFor(19_000);
      const path = await page.evaluate(() => window.path);
      assert.ok(path.length > 100, `${path.length} events`);
      const bends = path.slice(2).map((y, index) => Math.abs(y - 2 * path[index + 1] + path[index]));
      rough.push(bends.reduce((sum, bend) => sum + bend, 0) / bends.length);
      await close();
    }
    assert.ok(rough[1] > 3 * rough[0], `bends of ${rough} px`);
  });

  it("stays away where motion is to be reduced", async () => {
    const { page, visible, close } = await fresh({ reducedMotion: "reduce" });
    await page.clock.runFor(30_000);
    assert.equal(await visible(), false);
    await close();
  });
});
