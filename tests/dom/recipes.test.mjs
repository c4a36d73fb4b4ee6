// The recipes of docs/dom.md and docs/menu.md: pages in examples/dom/, over which Chromium's mouse moves.
import assert from "node:assert/strict";
import { readFileSync } from "node:fs";
import { after, before, describe, it } from "node:test";
import { join } from "node:path";
import { launch } from "../../scripts/chromium.mjs";
import { root } from "../../scripts/run.mjs";
import { serve } from "../../scripts/serve.mjs";
import { movement } from "../browser/hand.mjs";
import { mouse, nextFrame, REST } from "./support.mjs";

/** The middle of an element. */
async function middle(page, selector) {
  const { x, y, width, height } = await page.locator(selector).boundingBox();
  return { x: x + width / 2, y: y + height / 2, size: Math.min(width, height) };
}

/** Moves a hand from one place to another, up to a share of the way. */
async function reach(page, hand, from, to, share = 0.85) {
  await hand.play([[0, from.x, from.y]]);
  await hand.rest(REST);
  await hand.play(movement(from, to, to.size, { seed: 3, share }));
  await nextFrame(page);
}

describe("the recipes", () => {
  let host, browser;
  before(async () => {
    host = await serve(root);
    browser = await launch();
  });
  after(async () => {
    await browser?.close();
    await host?.close();
  });

  /** Opens a recipe; `requests` are the addresses that it has asked for. */
  async function open(t, name) {
    const page = await browser.newPage({ viewport: { width: 1000, height: 700 } });
    const errors = [];
    const requests = [];
    page.on("pageerror", (error) => errors.push(String(error)));
    page.on("request", (request) => requests.push(request.url().replace(host.url, "")));
    t.after(async () => {
      await page.close();
      assert.deepEqual(errors, []);
    });
    await page.goto(`${host.url}examples/dom/${name}.html`);
    return { page, requests, hand: await mouse(page) };
  }

  it("are in the documentation word for word", () => {
    const dom = readFileSync(join(root, "docs/dom.md"), "utf8");
    const menu = readFileSync(join(root, "docs/menu.md"), "utf8");
    for (const [text, expected] of [
      [dom, ["highlight", "prefetch", "enlarge", "canvas", "list", "store", "events", "learn"]],
      [menu, ["menu"]],
    ]) {
      const names = [...text.matchAll(/\]\(\.\.\/examples\/dom\/(\w+)\.html\)/g)].map(([, name]) => name);
      assert.deepEqual(names, expected);
      for (const name of names) {
        const page = readFileSync(join(root, `examples/dom/${name}.html`), "utf8");
        const [, script] = page.match(/<script type="module">\n(.*?) {4}<\/script>/s);
        assert.ok(text.includes(`\`\`\`js\n${script.replace(/^ {6}/gm, "").trim()}\n\`\`\``), `the script of ${name}.html`);
      }
    }
    const worker = readFileSync(join(root, "examples/dom/learn.js"), "utf8");
    const code = worker.replace("../../dist/index.js", "whither").replace("../../dist/study.js", "whither/study");
    assert.ok(dom.includes(`\`\`\`js\n${code.trim()}\n\`\`\``), "learn.js");
  });

  it("highlight: lights the button before the mouse is over it, by styles alone", async (t) => {
    const { page, hand } = await open(t, "highlight");
    const [from, to] = [await middle(page, "#radio"), await middle(page, "#camera")];
    await reach(page, hand, from, to, 0.7);
    assert.deepEqual(await page.evaluate(() => [...document.querySelectorAll("[data-predicted]")].map(({ id }) => id)), [
      "camera",
    ]);
    assert.equal(await page.evaluate(() => document.querySelector("#camera:hover")), null);
    await hand.rest(REST + 0.3);
    await nextFrame(page);
    assert.equal(await page.locator("[data-predicted]").count(), 0, "it does not stay where the pointer stops before it");
  });

  it("prefetch: asks once for what the mouse goes to, and stops a request when it turns away", async (t) => {
    const { page, requests, hand } = await open(t, "prefetch");
    const links = page.locator("nav a");
    const place = async (index) => {
      const { x, y, width, height } = await links.nth(index).boundingBox();
      return { x: x + width / 2, y: y + height / 2, size: height };
    };
    await reach(page, hand, await place(0), await place(5), 1);
    await page.waitForFunction(() => /^has .*events\.html$/.test(document.querySelector("#log").textContent));
    assert.equal(requests.filter((address) => address === "examples/dom/events.html").length, 1);
    // one that takes long
    const aborted = page.waitForEvent("requestfailed", (request) => request.url().endsWith("canvas.html"));
    await page.route("**/canvas.html", () => {});
    const [from, to] = [await place(5), await place(2)];
    await reach(page, hand, { x: from.x - 330, y: from.y + 200 }, to, 0.9);
    await page.waitForFunction(() => /^fetching .*canvas\.html$/.test(document.querySelector("#log").textContent));
    await hand.play(movement(to, { x: 60, y: 600 }, 40, { seed: 9 }).slice(8));
    assert.match((await aborted).failure().errorText, /ABORTED/);
  });

  it("enlarge: the button grows as it becomes probable", async (t) => {
    const { page, hand } = await open(t, "enlarge");
    const [from, to] = [await middle(page, "#radio"), await middle(page, "#seats")];
    const width = () => page.locator("#seats").evaluate((button) => button.getBoundingClientRect().width);
    const before = await width();
    await reach(page, hand, from, to);
    await page.waitForFunction((least) => document.querySelector("#seats").getBoundingClientRect().width > least, 1.2 * before);
  });

  it("canvas: a shape is drawn as large as it is probable", async (t) => {
    const { page, hand } = await open(t, "canvas");
    const canvas = await page.locator("#canvas").boundingBox();
    const at = (x, y) => ({ x: canvas.x + x, y: canvas.y + y, size: 80 });
    /** Whether a place 32 px from the middle of Bembridge is painted. */
    const painted = () =>
      page.evaluate(() => document.querySelector("#canvas").getContext("2d").getImageData(690, 348, 1, 1).data[3] > 0);
    assert.equal(await painted(), false);
    await reach(page, hand, at(120, 90), at(690, 380));
    assert.equal(await painted(), true);
  });

  it("list: opens the row that the mouse goes to, after scrolling too", async (t) => {
    const { page, hand } = await open(t, "list");
    await page.locator("#list").evaluate((list) => list.scrollTo(0, 20_000));
    await nextFrame(page);
    const number = await page.evaluate(() => {
      const { x, y, width } = document.querySelector("#list").getBoundingClientRect();
      return document.elementFromPoint(x + width / 2, y + 60).id;
    });
    await reach(page, hand, { x: 760, y: 600, size: 1 }, await middle(page, `#${number}`), 1);
    await page.waitForFunction(() => document.querySelector("#detail").textContent.startsWith("Opening"));
    const expected = await page.locator(`#${number}`).textContent();
    await page.waitForFunction((text) => document.querySelector("#detail").textContent.includes(text), expected);
  });

  it("store: calls back when the most probable target is another", async (t) => {
    const { page, hand } = await open(t, "store");
    await reach(page, hand, await middle(page, "#radio"), await middle(page, "#camera"));
    assert.equal(await page.locator("#best").textContent(), "camera");
    await hand.rest(REST + 0.2);
    await page.waitForFunction(() => document.querySelector("#best").textContent === "Between movements.");
  });

  it("events: a page without a callback is given the events", async (t) => {
    const { page, hand } = await open(t, "events");
    const place = async (text) => middle(page, `[data-preview="${text}"]`);
    const [from, to] = [await place("Ninety-two point four"), await place("All clear")];
    await reach(page, hand, from, to);
    assert.equal(await page.locator("article").textContent(), "All clear");
    await hand.play(movement(to, { x: 40, y: 660 }, 40, { seed: 4 }));
    await page.waitForFunction(() => document.querySelector("article").textContent === "");
  });

  it("menu: a submenu and a card stay open on the way to them; keys and fingers open, too", async (t) => {
    const { page, hand } = await open(t, "menu");
    const isOpen = (id) => page.locator(`#${id} > ul`).isVisible();
    const from = await middle(page, "#open > button");
    await hand.play([[0, from.x, from.y]]);
    await page.locator("#open > ul").waitFor();
    await hand.rest(REST);
    // across the items below
    await hand.play(movement(from, await middle(page, "#bembridge"), 32, { seed: 2 }));
    assert.equal(await isOpen("open"), true);
    await hand.rest(REST);
    await hand.play(movement(await middle(page, "#bembridge"), await middle(page, "#export > button"), 32, { seed: 3 }));
    await page.locator("#export > ul").waitFor();
    assert.equal(await isOpen("open"), false);
    const word = await middle(page, "#word");
    await hand.play(movement(await middle(page, "#export > button"), word, 32, { seed: 4 }));
    await page.locator("#card").waitFor();
    assert.equal(await isOpen("export"), false);
    await hand.rest(REST);
    await hand.play(movement(word, await middle(page, "#more"), 32, { seed: 5 }));
    await hand.rest(REST);
    assert.equal(await page.locator("#card").isVisible(), true);
    await hand.play(movement(await middle(page, "#more"), { x: 950, y: 100 }, 60, { seed: 6 }));
    await page.locator("#card").waitFor({ state: "hidden" });
    // a key opens what the pointer rests far from, and it stays
    await page.locator("#share > button").focus();
    await page.keyboard.press("Enter");
    await hand.rest(REST);
    assert.equal(await isOpen("share"), true);
  });

  it("learn: states how many presses it takes, and learns from them in a worker", async (t) => {
    const { page, hand } = await open(t, "learn");
    const [from, to] = [await middle(page, "#radio"), await middle(page, "#camera")];
    await reach(page, hand, from, to, 1);
    await hand.press(to);
    await page.locator("#learn").click();
    await page.waitForFunction(() => /at least 50 tracks .* has 1$/.test(document.querySelector("#gain").textContent));

    // made up: 60 movements among three targets, as lines of a ledger
    const targets = [
      [100, 100, 60, 60],
      [500, 80, 60, 60],
      [300, 560, 60, 60],
    ];
    const lines = Array.from({ length: 60 }, (_, k) => {
      const [x, y] = targets[k % 3];
      const samples = movement({ x: 300, y: 300 }, { x, y }, 60, { seed: k }).map(([time, ...place]) => [time, ...place]);
      return JSON.stringify({ targets, target: k % 3, samples });
    });
    const { leftOut, predicted } = await page.evaluate(async (all) => {
      const worker = new Worker("learn.js", { type: "module" });
      const { leftOut, constants } = await new Promise((resolve) => {
        worker.onmessage = ({ data }) => data.share === undefined && resolve(data);
        worker.postMessage(all);
      });
      const { watch } = await import("../../dist/dom.js");
      const errors = [];
      const watcher = watch("main button", { load: "eager", onError: (error) => errors.push(String(error)) });
      await watcher.ready;
      watcher.update({ constants });
      window.learnt = watcher;
      return { leftOut, predicted: errors };
    }, lines);
    assert.ok(leftOut.after < leftOut.before, JSON.stringify(leftOut));
    await reach(page, hand, to, from);
    assert.equal(await page.evaluate(() => window.learnt.best.id), "radio");
    assert.deepEqual(predicted, []);
  });
});
