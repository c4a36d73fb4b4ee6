// whither/menu in Chromium with its own mouse: what stays open on the way, what closes, and that nothing stands in the way of anything else.
import assert from "node:assert/strict";
import { describe, it } from "node:test";
import { movement } from "../browser/hand.mjs";
import { count } from "./standing.mjs";
import { hosted, mouse, nextFrame, open as openPage, REST } from "./support.mjs";

/** An item's size, where the list is, and a submenu's width (px). */
const ITEM = { width: 180, height: 32 };
const LIST = { x: 400, y: 200 };
const PANEL = 200;

const sleep = (seconds) => new Promise((resolve) => setTimeout(resolve, 1000 * seconds));

/** The styles of a page of menus: submenus to the right and aligned, unless `more` has others. */
const styles = (more = "") => `<style>
  ul { list-style: none; margin: 0; padding: 0; width: ${ITEM.width}px; background: #eee; font: 14px sans-serif }
  li { position: relative; height: ${ITEM.height}px; line-height: ${ITEM.height}px }
  #menu { position: absolute; left: ${LIST.x}px; top: ${LIST.y}px }
  li > ul { position: absolute; left: 100%; top: 0; width: ${PANEL}px; z-index: 1; background: #cde }
  [hidden] { display: none }
  ${more}
</style>`;

/** Items, named by their path: three with submenus of six, of which the second has one of its own. */
const list = (names, inside = () => "") => names.map((name) => `<li id="${name}">${name}${inside(name)}</li>`).join("");
const numbered = (name, count) => Array.from({ length: count }, (_, k) => `${name}${k + 1}`);
const panel = (name, items) => `<ul id="${name}-panel" hidden>${items}</ul>`;
const innermost = (name) => (name.endsWith("2") ? panel(name, list(numbered(name, 4))) : "");
const submenu = (inside) => (name) => ("abc".includes(name) ? panel(name, list(numbered(name, 6), inside)) : "");
const MENU = `<ul id="menu">${list([..."abcdef"], submenu(innermost))}</ul>`;

/** The same, without the innermost. */
const SIMPLE = `<ul id="menu">${list([..."abcdef"], submenu())}</ul>`;

/**
 * Opens a page of menus whose openings and closings are logged, with options (text). A machine that is busy sends the mouse's events late, so
 * nothing is let go for that unless a test is about it.
 */
async function openMenu(site, { head = styles(), body = MENU, options = "{}", script, ...more } = {}) {
  const opened = await openPage(site, body, {
    head,
    script: `
      const { menu, heldOpen } = await import("./menu.js");
      const warm = whither.watch([], { load: "eager", onError() {} });
      await warm.ready.catch(() => {});
      warm.stop();
      Object.assign(window, { menu, heldOpen, log: [] });
      const note = (kind, id, why) => log.push({ kind, id, why, time: performance.now() });
      ${
        script ??
        `const { show, hide } = { show: ({ panel }) => (panel.hidden = false), hide: ({ panel }) => (panel.hidden = true) };
        window.menus = menu(document.querySelector("#menu"), {
          onOpen(opening) { note("open", opening.item.id); show(opening); },
          onClose(closing) { note("close", closing.item.id, closing.why); hide(closing); },
          rest: 1000,
          bound: 5000,
          ...${options},
        });`
      }`,
    ...more,
  });
  const { page } = opened;
  return {
    ...opened,
    hand: await mouse(page),
    /** What was logged, without times: `open a`, `close a away`. */
    log: () => page.evaluate(() => log.map(({ kind, id, why }) => [kind, id, why].filter(Boolean).join(" "))),
    /** Until so much was logged. */
    until: (count) => page.waitForFunction((count) => log.length >= count, count, { timeout: 3000 }),
    middle: async (selector) => {
      const { x, y, width, height } = await page.locator(selector).boundingBox();
      return { x: x + width / 2, y: y + height / 2 };
    },
  };
}

/** A place in an item of the list, `share` of the way to its right edge. */
const inItem = (index, share = 0.5) => ({ x: LIST.x + share * ITEM.width, y: LIST.y + (index + 0.5) * ITEM.height });

/** Rests on a place, long enough for what was loaded to be there. */
async function restOn(hand, page, { x, y }) {
  await hand.play([
    [0, x, y - 2],
    [0.02, x, y],
  ]);
  await hand.rest(REST);
  await nextFrame(page);
}

describe("whither/menu", () => {
  const site = hosted();

  it("opens what the pointer comes to, and switches at once to another item", async () => {
    const { page, hand, log, close } = await openMenu(site);
    await restOn(hand, page, inItem(0));
    assert.deepEqual(await log(), ["open a"]);
    await hand.play(movement(inItem(0), inItem(2, 0.4), 32, { seed: 1 }));
    await page.waitForFunction(() => log.at(-1).kind === "open" && log.at(-1).id === "c", null, { timeout: 3000 });
    // on its way it may have opened the one between
    assert.deepEqual(
      (await log()).filter((line) => !line.includes(" b")),
      ["open a", "close a away", "open c"],
    );
    // down, out of the list
    await hand.play(movement(inItem(2, 0.4), { x: 440, y: 640 }, 60, { seed: 2 }));
    await page.waitForFunction(() => log.at(-1).kind === "close", null, { timeout: 3000 });
    assert.equal((await log()).at(-1), "close c away");
    await close();
  });

  for (const seed of [1, 2, 3, 4])
    it(`stays open on the way to a low item, across two siblings that have submenus (hand ${seed})`, async () => {
      const { page, hand, log, middle, close } = await openMenu(site);
      await restOn(hand, page, inItem(0, 0.7));
      const to = await middle("#a5");
      const samples = movement(inItem(0, 0.7), to, 32, { seed });
      const crossed = samples.filter(([, x, y]) => x < LIST.x + ITEM.width && y > LIST.y + ITEM.height);
      assert.ok(crossed.length > 3, `it has to cross siblings: ${crossed.length}`);
      await hand.play(samples);
      await sleep(0.3);
      // a2, in the panel, has a submenu of its own
      assert.deepEqual(
        (await log()).filter((line) => !line.includes(" a2")),
        ["open a"],
      );
      assert.equal(await page.evaluate(() => document.querySelector("#a5").matches(":hover")), true);
      await close();
    });

  it("lets go at once where the pointer turns away on its way", async () => {
    const { page, hand, log, until, middle, close } = await openMenu(site);
    await restOn(hand, page, inItem(0, 0.7));
    const to = await middle("#a5");
    const way = movement(inItem(0, 0.7), to, 32, { seed: 5 }).filter(([, x]) => x < LIST.x + ITEM.width - 6);
    const [time, x, y] = way.at(-1);
    // back and down to the last item
    const back = movement({ x, y }, inItem(5, 0.3), 32, { seed: 6 });
    await hand.play([...way, ...back.slice(1).map(([t, ...place]) => [time + t, ...place])]);
    await until(2);
    assert.equal((await log())[1], "close a away");
    const { closed, arrived } = await page.evaluate(() => ({ closed: log[1].time, arrived: performance.now() }));
    assert.ok(closed < arrived, `${closed} ${arrived}`);
    await close();
  });

  it("closes at once, and opens nothing, where the pointer goes elsewhere, on every side", async () => {
    for (const [k, to] of [
      { x: LIST.x - 250, y: LIST.y + 60 },
      { x: LIST.x + 60, y: LIST.y - 160 },
      { x: LIST.x - 150, y: LIST.y + 400 },
    ].entries()) {
      const { page, hand, log, until, close } = await openMenu(site);
      await restOn(hand, page, inItem(0, 0.3));
      await hand.play(movement(inItem(0, 0.3), to, 60, { seed: 7 + k }));
      const arrived = await page.evaluate(() => performance.now());
      await until(2);
      assert.equal((await log())[1], "close a away");
      assert.ok((await page.evaluate(() => log[1].time)) < arrived, "before the pointer is there");
      await close();
    }
  });

  const layouts = {
    "to the left, in a page that is read from right to left": {
      head: styles(`li > ul { left: auto; right: 100% }`),
      direction: "rtl",
    },
    "far away": { head: styles("li > ul { left: calc(100% + 160px) }") },
    "tall, above and below": { head: styles("li > ul { top: -180px; padding: 180px 0 }") },
    "above, of a bar": {
      head: styles(`#menu { display: flex; top: 420px; width: 700px; left: 150px } #menu > li { width: ${ITEM.width - 60}px }
        li > ul { left: 0; top: auto; bottom: 100% }`),
    },
    "below, of a bar": {
      head: styles(`#menu { display: flex; width: 700px; left: 150px } #menu > li { width: ${ITEM.width - 60}px }
        li > ul { left: 60px; top: 100% }`),
    },
  };
  for (const [name, { head, direction = "ltr" }] of Object.entries(layouts))
    it(`holds a submenu ${name}, across siblings, and lets go of it`, async () => {
      const { page, hand, log, until, middle, close } = await openMenu(site, {
        head,
        body: SIMPLE.replace("<ul", `<ul dir="${direction}"`),
      });
      const from = await middle("#b");
      await restOn(hand, page, from);
      const to = await middle("#b5");
      await hand.play(movement(from, to, 32, { seed: 11 }));
      await sleep(0.2);
      assert.deepEqual(await log(), ["open b"]);
      // back to the trigger, and away
      await hand.play(movement(to, from, 32, { seed: 12 }));
      await hand.rest(REST);
      assert.deepEqual(await log(), ["open b"]);
      const mirrored = { x: 2 * from.x - to.x, y: 2 * from.y - to.y };
      await hand.play(movement(from, mirrored, 60, { seed: 13, share: 0.9 }));
      await until(2);
      assert.equal((await log())[1], "close b away");
      await close();
    });

  it("has submenus of submenus, and a way back through them", async () => {
    const { page, hand, log, until, middle, close } = await openMenu(site);
    await restOn(hand, page, inItem(0, 0.7));
    const inner = await middle("#a2");
    await hand.play(movement(inItem(0, 0.7), inner, 32, { seed: 14 }));
    await until(2);
    assert.deepEqual(await log(), ["open a", "open a2"]);
    await hand.rest(REST);
    const innermost = await middle("#a24");
    await hand.play(movement(inner, innermost, 32, { seed: 15 }));
    await hand.rest(REST);
    assert.deepEqual(await log(), ["open a", "open a2"]);
    // another item of the first submenu: the inner one alone is closed
    const sibling = await middle("#a6");
    await hand.play(movement(innermost, sibling, 32, { seed: 16 }));
    await until(3);
    await hand.rest(REST);
    assert.deepEqual(await log(), ["open a", "open a2", "close a2 away"]);
    assert.deepEqual(await page.evaluate(() => menus.open.map(({ item }) => item.id)), ["a"]);
    // out of everything
    await hand.play(movement(sibling, { x: 60, y: 640 }, 60, { seed: 17 }));
    await until(4);
    assert.equal((await log())[3].slice(0, 7), "close a");
    await close();
  });

  it("holds for no longer than the bound, however surely the pointer is on its way", async () => {
    const { page, hand, log, until, close } = await openMenu(site, {
      head: styles("li > ul { left: calc(100% + 300px); height: 300px }"),
      options: "{ bound: 400 }",
    });
    await restOn(hand, page, inItem(0, 0.9));
    const from = inItem(0, 0.9);
    // 1.5 seconds to the panel, and straight to it
    const slow = Array.from({ length: 150 }, (_, k) => [k / 100, from.x + 2.1 * k, from.y]);
    await hand.play(slow);
    await until(2);
    assert.deepEqual(await log(), ["open a", "close a bound"]);
    await close();
  });

  it("waits between trigger and panel for a pointer that pauses, and not beside them", async () => {
    const far = { head: styles("li > ul { left: calc(100% + 120px); height: 300px }") };
    for (const [aside, expected] of [
      [0, ["open a"]],
      [90, ["open a", "close a rest"]],
    ]) {
      const { page, hand, log, until, close } = await openMenu(site, { ...far, options: "{ release: 0.01, rest: 150 }" });
      const from = inItem(0, 0.9);
      await restOn(hand, page, from);
      await hand.play(movement(from, { x: from.x + 80, y: from.y + aside }, 60, { seed: 18 }));
      await hand.rest(0.6);
      if (aside) await until(2);
      assert.deepEqual(await log(), expected);
      await close();
    }
  });

  it("closes what it holds after 300 ms where WebAssembly is forbidden, and reports why", async () => {
    const { page, problems, hand, log, until, close } = await openMenu(site, {
      headers: { "content-security-policy": "script-src 'self' 'unsafe-inline'" },
      options: "{ onError: ({ code }) => note('error', code) }",
    });
    await restOn(hand, page, inItem(0, 0.9));
    await hand.play(movement(inItem(0, 0.9), inItem(4, 0.3), 32, { seed: 19 }));
    await until(3);
    assert.deepEqual(await log(), ["open a", "error wasm-unavailable", "close a unknown"]);
    problems.length = 0;
    await close();
  });

  it("leaves touches, keys, presses and the focus to the page", async () => {
    const { page, hand, log, middle, close } = await openMenu(site, {
      hasTouch: true,
      body: SIMPLE.replace('<li id="a1">a1', '<li id="a1"><input id="field">'),
    });
    await page.touchscreen.tap(inItem(0).x, inItem(0).y);
    await sleep(0.1);
    assert.deepEqual(await log(), [], "a finger opens nothing");
    await restOn(hand, page, inItem(0, 0.7));
    assert.deepEqual(await log(), ["open a"]);
    await hand.play(movement(inItem(0, 0.7), await middle("#a1"), 32, { seed: 20 }));
    await hand.press(await middle("#a1"));
    await page.keyboard.type("text");
    await hand.play(movement(await middle("#a1"), { x: 80, y: 600 }, 60, { seed: 21 }));
    await sleep(0.3);
    assert.deepEqual(await log(), ["open a"], "it is being written in");
    assert.equal(await page.locator("#field").inputValue(), "text");
    await close();
  });

  it("opens nothing that is scrolled under a resting pointer", async () => {
    const { page, hand, log, until, close } = await openMenu(site, { body: `${MENU}<p style="height:3000px"></p>` });
    const resting = { x: inItem(0).x, y: 100 };
    await restOn(hand, page, resting);
    await page.evaluate(() => scrollTo(0, 110));
    await sleep(0.3);
    assert.deepEqual(await log(), []);
    await hand.play([[0, resting.x + 3, resting.y]]);
    await until(1);
    assert.deepEqual(await log(), ["open a"]);
    await close();
  });

  it("holds what the page has opened like what it has opened itself, and leaves it open when it stops", async () => {
    const { page, hand, log, until, middle, close } = await openMenu(site, { body: SIMPLE });
    await restOn(hand, page, inItem(4, 0.8));
    // by a key or a click, the page's own
    const openB = () => page.evaluate(() => (document.querySelector("#b-panel").hidden = false));
    await openB();
    await hand.rest(REST);
    await hand.play(movement(inItem(4, 0.8), await middle("#b4"), 32, { seed: 26 }));
    await hand.rest(REST);
    assert.deepEqual(await log(), []);
    assert.deepEqual(await page.evaluate(() => menus.open.map(({ item }) => item.id)), ["b"]);
    await hand.play(movement(await middle("#b4"), inItem(0, 0.3), 32, { seed: 27 }));
    await until(2);
    const [closed, opened] = await log();
    assert.match(closed, /^close b (away|rest)$/);
    assert.equal(opened, "open a");
    await openB();
    await page.evaluate(() => menus.stop());
    assert.deepEqual(await page.evaluate(() => [...document.querySelectorAll("#menu ul:not([hidden])")].map(({ id }) => id)), [
      "b-panel",
    ]);
    await close();
  });

  it("stops: what it opened is closed, and nothing is left on the page", async () => {
    const { page, hand, middle, close } = await openMenu(site, {
      head: `<script>(${count})()</script>${styles()}`,
      script: `window.note = note`,
    });
    const html = () => page.evaluate(() => document.querySelector("#menu").outerHTML);
    const standing = () => page.evaluate(() => window.standing());
    const [before, page0] = [await standing(), await html()];
    await page.evaluate(() => {
      window.menus = menu(document.querySelector("#menu"));
      window.card = heldOpen(document.querySelector("#b"), document.querySelector("#b-panel"), {
        onClose() {},
        delay: 5000,
        onOpen() {},
      });
    });
    assert.ok((await standing()).listeners > before.listeners);
    await restOn(hand, page, inItem(1, 0.7));
    assert.equal(await page.locator("#b").getAttribute("aria-expanded"), "true");
    // in the middle of things
    await hand.play(movement(inItem(1, 0.7), await middle("#b6"), 32, { seed: 22, share: 0.5 }));
    assert.ok((await standing()).observers > before.observers);
    await page.evaluate(() => {
      menus.stop();
      card.stop();
      card[Symbol.dispose]?.();
    });
    assert.deepEqual(await standing(), before);
    assert.equal(await html(), page0);
    await restOn(hand, page, inItem(2));
    assert.deepEqual(await standing(), before);
    await close();
  });

  it("holds anything open: a card beside a word, mounted when it opens", async () => {
    const { page, hand, log, until, close } = await openMenu(site, {
      head: `<style>#word { position: absolute; left: 300px; top: 300px; width: 90px; height: 24px; background: #ccc }
        #card { position: absolute; left: 250px; top: 400px; width: 320px; height: 180px; background: #cde }</style>`,
      body: `<span id="word">word</span>`,
      script: `
        const panel = () => document.querySelector("#card");
        window.card = heldOpen(document.querySelector("#word"), panel, {
          delay: 150,
          rest: 1000,
          bound: 5000,
          onOpen() { note("open", "card"); document.body.insertAdjacentHTML("beforeend", '<div id="card">card</div>'); },
          onClose({ why, over }) { note("close", over?.localName ?? "nothing", why); panel().remove(); },
        });`,
    });
    const word = { x: 345, y: 312 };
    // what only passes opens nothing
    await hand.play(movement({ x: 200, y: 250 }, { x: 620, y: 350 }, 60, { seed: 23 }));
    assert.deepEqual(await log(), []);
    await restOn(hand, page, word);
    await until(1);
    await hand.play(movement(word, { x: 480, y: 520 }, 60, { seed: 24 }));
    await hand.rest(REST);
    assert.deepEqual(await log(), ["open card"]);
    assert.equal(await page.evaluate(() => card.held), false);
    await hand.play(movement({ x: 480, y: 520 }, { x: 940, y: 80 }, 60, { seed: 25 }));
    await until(2);
    assert.deepEqual(await log(), ["open card", "close html away"]);
    assert.equal(await page.evaluate(() => card.probability), 0);
    await close();
  });
});
