// The panel of whither/overlay by the keyboard and by hand, for everybody, and that nothing is left of it.
import assert from "node:assert/strict";
import { readFileSync } from "node:fs";
import { createRequire } from "node:module";
import { describe, it } from "node:test";
import { openDrawn } from "./drawn.mjs";
import { buttons, CORNERS, hosted, MIDDLE, mouse, reach } from "./page.mjs";
import { count } from "./standing.mjs";

const axe = readFileSync(createRequire(import.meta.url).resolve("axe-core/axe.min.js"), "utf8");

describe("the overlay's panel", () => {
  const site = hosted();
  const place = (page) => page.evaluate(() => part(".panel").getBoundingClientRect().toJSON());
  const focused = (page) =>
    page.evaluate(() => shadow()?.activeElement?.getAttribute("aria-label") ?? shadow()?.activeElement?.localName ?? null);

  it("is hidden and shown by its shortcut, with the focus in it and back where it was", async () => {
    const { page, close } = await openDrawn(site, CORNERS);
    const state = () => page.evaluate(() => [drawn.state, part(".panel").checkVisibility()]);
    assert.deepEqual(await state(), ["shown", true]);
    await page.keyboard.press("Alt+Shift+W");
    assert.deepEqual(await state(), ["hidden", false]);
    await page.focus("#b");
    await page.keyboard.press("Alt+Shift+W");
    assert.deepEqual(await state(), ["shown", true]);
    assert.equal(await focused(page), "Fold");
    await page.keyboard.press("Alt+Shift+W");
    assert.equal(await page.evaluate(() => document.activeElement.id), "b");
    await page.keyboard.press("Alt+W");
    assert.deepEqual(await state(), ["hidden", false]);
    await page.evaluate(() => (drawn = overlay(watcher, { shortcut: "Ctrl+9" })));
    await page.keyboard.press("Alt+Shift+W");
    assert.deepEqual(await state(), ["shown", true]);
    await page.keyboard.press("Control+9");
    assert.deepEqual(await state(), ["hidden", false]);
    await close();
  });

  it("is reached by Tab, folds at Escape, then hides, and closes by its button", async () => {
    const { page, close } = await openDrawn(site, CORNERS);
    await page.focus("#c");
    const order = [];
    for (let k = 0; k < 7; k++) {
      await page.keyboard.press("Tab");
      order.push(await focused(page));
    }
    const header = ["Move: arrow keys", "Fold", "Close (Alt+Shift+W hides)"];
    assert.deepEqual(order, [...header, "summary", "Intents, the last first", "summary", "summary"]);
    await page.keyboard.press("Enter");
    assert.equal(await page.evaluate(() => parts("details").at(-1).open), true);
    const outline = await page.evaluate(() => getComputedStyle(shadow().activeElement).outlineStyle);
    assert.equal(outline, "solid", "the focus shows");
    await page.keyboard.press("Escape");
    assert.equal(await page.evaluate(() => part(".body").checkVisibility()), false);
    assert.equal(await focused(page), "Unfold");
    await page.keyboard.press("Enter");
    assert.equal(await page.evaluate(() => part(".body").checkVisibility()), true);
    await page.keyboard.press("Escape");
    await page.keyboard.press("Escape");
    assert.equal(await page.evaluate(() => drawn.state), "hidden");
    await page.keyboard.press("Alt+Shift+W");
    await page.keyboard.press("Tab");
    await page.keyboard.press("Enter");
    assert.deepEqual(await page.evaluate(() => [drawn.state, document.querySelector("whither-overlay")]), ["closed", null]);
    await close();
  });

  it("is moved by arrow keys and by its header, and stays in the window", async () => {
    const { page, close } = await openDrawn(site, CORNERS);
    const start = await place(page);
    await page.evaluate(() => part(".grip").focus());
    await page.keyboard.press("ArrowLeft");
    await page.keyboard.press("ArrowUp");
    const stepped = await place(page);
    assert.deepEqual([Math.round(stepped.x - start.x), Math.round(stepped.y - start.y)], [-24, -24]);
    const heading = { x: stepped.x + 120, y: stepped.y + 16 };
    await page.mouse.move(heading.x, heading.y);
    await page.mouse.down();
    await page.mouse.move(heading.x - 300, heading.y - 100, { steps: 4 });
    await page.mouse.up();
    await page.mouse.move(10, 10);
    const dragged = await place(page);
    assert.deepEqual([dragged.x - stepped.x, dragged.y - stepped.y], [-300, -100]);
    await page.evaluate(() => part(".grip").focus());
    for (let k = 0; k < 60; k++) await page.keyboard.press("ArrowRight");
    assert.equal((await place(page)).right, 1000);
    await page.setViewportSize({ width: 640, height: 500 });
    await page.evaluate(() => frames(3));
    assert.equal((await place(page)).right, 640);
    await close();
  });

  it("is across the bottom of a phone's window, folded, and its buttons are large", async () => {
    const { page, close } = await openDrawn(site, buttons(["a", 80, 80]), {
      viewport: { width: 390, height: 844 },
      head: '<meta name="viewport" content="width=device-width,initial-scale=1">',
      hasTouch: true,
      isMobile: true,
      deviceScaleFactor: 3,
    });
    const { x, right, bottom, height } = await place(page);
    assert.deepEqual([x, right, bottom], [8, 382, 836]);
    assert.ok(height < 60, `${height}`);
    await page.evaluate(() => (window.at = part("[aria-label=Unfold]").getBoundingClientRect()));
    const button = await page.evaluate(() => at.toJSON());
    assert.ok(button.width >= 40 && button.height >= 40);
    await page.touchscreen.tap(button.x + 20, button.y + 20);
    assert.equal(await page.evaluate(() => part(".body").checkVisibility()), true);
    assert.ok((await place(page)).height <= 0.56 * 844 + 1);
    await close();
  });

  it("has nothing that keeps people from using it, dark and light, folded and not (axe)", async () => {
    for (const colorScheme of ["dark", "light"]) {
      const { page, close } = await openDrawn(site, CORNERS, { colorScheme });
      const hand = await mouse(page);
      await reach(hand, MIDDLE.a);
      await hand.press(MIDDLE.a);
      await page.evaluate(axe);
      const found = () =>
        page.evaluate(async () => {
          await frames(3);
          const { violations, passes } = await axe.run(document.querySelector("whither-overlay"));
          const where = ({ id, nodes }) =>
            `${id}: ${nodes.map(({ html, failureSummary }) => `${html} ${failureSummary}`).join("; ")}`;
          return { violations: violations.map(where), passes: passes.length };
        });
      await page.evaluate(() => parts("details").forEach((details) => (details.open = true)));
      const open = await found();
      assert.deepEqual(open.violations, []);
      assert.ok(open.passes > 10, `${open.passes} rules`);
      await page.evaluate(() => part("[aria-label=Fold]").click());
      assert.deepEqual((await found()).violations, []);
      await close();
    }
  });
});

describe("closing the overlay", () => {
  const site = hosted();

  it("leaves nothing: elements, listeners, observers, frames, timers", async () => {
    const { page, close } = await openDrawn(site, CORNERS, {
      head: `<script>(${count})()</script>`,
      options: "{ decorate: false }",
      overlaid: "[]",
    });
    const counted = () =>
      page.evaluate(async () => {
        await frames(3);
        return { ...standing(), html: document.documentElement.outerHTML };
      });
    await page.evaluate(() => drawn.close());
    const before = await counted();
    const ends = {
      "close()": () => page.evaluate(() => drawn.close()),
      using: () => page.evaluate(() => drawn[Symbol.dispose]()),
      "its signal": () => page.evaluate(() => stop.abort()),
      "another overlay": () => page.evaluate(() => overlay().close()),
      "its button": () => page.evaluate(() => part("[aria-label^=Close]").click()),
    };
    for (const [name, end] of Object.entries(ends)) {
      await page.evaluate(async () => {
        window.stop = new AbortController();
        window.drawn = overlay(null, { signal: stop.signal });
        await frames(2);
        parts("details").forEach((details) => (details.open = true));
      });
      const during = await counted();
      assert.ok(during.listeners > before.listeners && during.observers > before.observers, JSON.stringify(during));
      assert.ok(during.waiting.requestAnimationFrame > before.waiting.requestAnimationFrame);
      const hand = await mouse(page);
      await hand.play([
        [0, 300, 300],
        [0.05, 320, 320],
      ]);
      await end();
      await hand.rest(0.4);
      await page.evaluate(() => frames(30));
      assert.deepEqual(await counted(), before, name);
      assert.equal(await page.evaluate(() => drawn.state), "closed");
    }
    await close();
  });

  it("is for good, and hiding is not: nothing is drawn, and intents are noted", async () => {
    const { page, close } = await openDrawn(site, CORNERS, { head: `<script>(${count})()</script>` });
    await page.evaluate(() => drawn.hide());
    const standing = await page.evaluate(async () => (await frames(3), window.standing().waiting.requestAnimationFrame));
    assert.equal(standing, 0, "no frame is asked for");
    await reach(await mouse(page), MIDDLE.a);
    await page.evaluate(async () => {
      drawn.show();
      await frames(3);
    });
    assert.match((await page.evaluate(() => logLines()))[0][0], /^a pointer/);
    await page.evaluate(() => {
      drawn.close();
      drawn.show();
      drawn.hide();
      drawn.close();
    });
    assert.deepEqual(await page.evaluate(() => [drawn.state, document.querySelector("whither-overlay")]), ["closed", null]);
    await close();
  });
});
