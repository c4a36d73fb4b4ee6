// When the layout is read: never in a pointer event, not while nothing changes, and seldom while a pointer moves.
import assert from "node:assert/strict";
import { describe, it } from "node:test";
import { movement } from "../browser/hand.mjs";
import { hosted, open, START } from "./aim.mjs";
import { mouse, nextFrame, REST } from "./support.mjs";

/**
 * Runs before anything else on a page: collects in the window's `reads` what makes the browser compute style or layout, each as
 * `{ name, event }`, in `requested` the frames that are asked for, and in `perFrame` how many reads there were in each. `event` is
 * the type of the pointer or mouse event whose listeners run.
 */
function count() {
  const all = (top.reads ??= []);
  top.requested ??= 0;
  let event = null;
  const wrap = (owner, ...names) => {
    for (const name of names) {
      const descriptor = Object.getOwnPropertyDescriptor(owner, name);
      const key = descriptor.get ? "get" : "value";
      const original = descriptor[key];
      const counted = function (...args) {
        all.push({ name, event });
        return original.apply(this, args);
      };
      Object.defineProperty(owner, name, { ...descriptor, [key]: counted });
    }
  };
  const sides = (before) => ["Left", "Top", "Width", "Height"].map((side) => before + side);
  wrap(Element.prototype, "getBoundingClientRect", "getClientRects", "checkVisibility", "computedStyleMap");
  wrap(Element.prototype, ...sides("client"), ...sides("scroll"));
  wrap(HTMLElement.prototype, ...sides("offset"), "offsetParent", "innerText");
  wrap(Range.prototype, "getBoundingClientRect", "getClientRects");
  wrap(Document.prototype, "elementFromPoint", "elementsFromPoint");
  wrap(ShadowRoot.prototype, "elementFromPoint", "elementsFromPoint");
  wrap(VisualViewport.prototype, "offsetLeft", "offsetTop", "pageLeft", "pageTop", "width", "height", "scale");
  wrap(MouseEvent.prototype, "offsetX", "offsetY", "layerX", "layerY");
  wrap(SVGGraphicsElement.prototype, "getBBox", "getCTM", "getScreenCTM");
  wrap(window, "getComputedStyle", "innerWidth", "innerHeight", "scrollX", "scrollY", "pageXOffset", "pageYOffset");

  const request = window.requestAnimationFrame;
  window.requestAnimationFrame = (callback) => {
    top.requested++;
    return request.call(window, callback);
  };
  // how much is read in each frame
  top.perFrame ??= [];
  top.before ??= 0;
  const frame = () => {
    top.perFrame.push(all.length - top.before);
    top.before = all.length;
    request.call(window, frame);
  };
  if (window === top) frame();

  const actions = ["move", "rawupdate", "down", "up", "over", "out", "enter", "leave"].map((action) => `pointer${action}`);
  const types = [...actions, "mousemove", "mousedown", "mouseup", "click"];
  top.events ??= 0;
  const began = ({ type }) => (top.events++, (event = type));
  const ended = () => (event = null);
  for (const type of types) addEventListener(type, began, { capture: true });
  // after those of the page, which are added meanwhile
  addEventListener("load", () => {
    for (const type of types) addEventListener(type, ended);
  });
}

const COUNT = `<script>(${count})()</script>`;

/** So many targets that fill the window. */
const grid = (columns, rows, of = "target") =>
  Array.from({ length: columns * rows }, (_, k) => {
    const [left, top] = [k % columns, Math.floor(k / columns)].map((place) => 25 * place);
    return `<button class="${of} place" id="t${k}" style="left: ${left}px; top: ${top}px; width: 20px; height: 20px"></button>`;
  }).join("");

describe("reads of the layout", () => {
  const site = hosted();
  const end = { x: 712, y: 362 };
  const way = movement(START, end, 20, { seed: 7 });

  /** The pointer moves and rests, and what was counted meanwhile is returned. */
  async function move(page, hand = null) {
    const own = hand ?? (await mouse(page));
    await own.play([[0, START.x, START.y]]);
    await own.rest(REST);
    await page.evaluate(() => ([before, perFrame.length] = [reads.length, 0]));
    await own.play(way);
    await nextFrame(page);
    return page.evaluate(() => ({ reads, perFrame, predicted: predictions.filter(({ best }) => best).length }));
  }

  it("happen in no pointer event", async () => {
    const { page, close } = await open(site, grid(10, 10), { head: COUNT, options: "{ raw: true }" });
    const hand = await mouse(page);
    const { predicted } = await move(page, hand);
    await hand.press(end);
    await hand.play([[0, START.x, START.y]]);
    await nextFrame(page);
    const [all, events] = await page.evaluate(() => [reads, top.events]);
    await close();
    assert.ok(predicted > 5 && events > 100, `${predicted} predictions, ${events} events`);
    assert.deepEqual(
      all.filter(({ event }) => event !== null),
      [],
    );
  });

  it("happen in no pointer event of an iframe", async () => {
    const { page, close } = await open(
      site,
      '<iframe src="inner.html" class="place" style="border: 0; left: 50px; top: 50px; width: 800px; height: 600px"></iframe>',
      {
        head: COUNT,
        pages: { "inner.html": `<!doctype html><style>.place { position: absolute }</style>${COUNT}${grid(10, 10)}` },
        first: `const frame = document.querySelector("iframe");
          if (frame.contentDocument.readyState !== "complete" || frame.contentDocument.URL === "about:blank")
            await new Promise((resolve) => frame.addEventListener("load", resolve));`,
        watched: 'frame.contentDocument.querySelectorAll(".target")',
      },
    );
    const { reads, predicted } = await move(page);
    await close();
    assert.ok(predicted > 5, `${predicted} predictions`);
    assert.deepEqual(
      reads.filter(({ event }) => event !== null),
      [],
    );
  });

  it("do not happen, and no frame is asked for, while nothing changes and no pointer moves", async () => {
    const { page, close } = await open(site, grid(10, 10), { head: COUNT });
    const { predicted } = await move(page);
    await page.waitForFunction(() => !watcher.getSnapshot().moving);
    const counts = await page.evaluate(async () => {
      await new Promise((resolve) => setTimeout(resolve, 300));
      [reads.length, perFrame.length, requested] = [0, 0, 0];
      await new Promise((resolve) => setTimeout(resolve, 800));
      return { reads: reads.length, requested, frames: perFrame.length };
    });
    await close();
    assert.ok(predicted > 5 && counts.frames > 10);
    assert.deepEqual([counts.reads, counts.requested], [0, 0]);
  });

  /** At most so many in an ordinary frame of a movement, and in one in which something is found out, for each watcher. */
  const HANDFUL = 12;
  const MANY = 80;

  const pages = {
    "with a hundred targets": [grid(10, 10), 1],
    "with a thousand targets": [grid(40, 25), 1],
    "with two watchers of the same targets, which both decorate them": [grid(40, 25), 2],
  };
  for (const [name, [body, watchers]] of Object.entries(pages)) {
    it(`are a handful in a frame of a movement, ${name}`, async () => {
      const first = watchers > 1 ? 'window.other = whither.watch(".target", { load: "eager" }); await other.ready;' : "";
      const { page, close } = await open(site, body, { head: COUNT, first });
      await move(page); // what is read once is read
      const hand = await mouse(page);
      await hand.rest(REST);
      const { perFrame, predicted } = await move(page, hand);
      await close();
      assert.ok(predicted > 5, `${predicted} predictions`);
      const moving = perFrame.filter((count) => count > 0).sort((a, b) => a - b);
      const shown = `in the frames: ${perFrame.join(" ")}`;
      assert.ok(moving.length > 5, shown);
      assert.ok(moving[moving.length >> 1] <= HANDFUL * watchers, shown);
      // all are read when a movement begins
      assert.ok(moving.filter((count) => count > MANY * watchers).length <= watchers, shown);
    });
  }

  it("are of no styles while something else on the page is animated by its style attribute", async () => {
    const body = `${grid(40, 25)}<div id="spinner" class="place" style="left: 0; top: 650px"><i></i></div><script>
      (function step(time) {
        spinner.style.transform = "rotate(" + time + "deg)";
        requestAnimationFrame(step);
      })(0)</script>`;
    const { page, close } = await open(site, body, { head: COUNT });
    await move(page);
    const hand = await mouse(page);
    await hand.rest(REST);
    await page.evaluate(() => (reads.length = 0));
    const { reads: all, perFrame } = await move(page, hand);
    await close();
    const of = (name) => all.filter((read) => read.name === name).length;
    assert.ok(of("getBoundingClientRect") > 1000, "the boxes are read");
    assert.ok(of("getComputedStyle") < 100, `${of("getComputedStyle")} styles in ${perFrame.length} frames`);
  });

  it("are of the rows that can be seen: of five thousand in a scroller those take part", async () => {
    const rows = Array.from({ length: 5000 }, (_, k) => `<li class="target" id="t${k}" style="width: 300px; height: 30px"></li>`);
    const body = `<ul id="list" class="place" style="left: 500px; top: 50px; height: 600px; overflow: auto; margin: 0; padding: 0">${rows.join("")}</ul>`;
    const { page, close } = await open(site, body, { head: COUNT });
    const taking = () =>
      page.evaluate(() => {
        const ids = [...document.querySelectorAll(".target")].filter((row) => watcher.probability(row) > 0).map(({ id }) => id);
        return { first: ids[0], count: ids.length, targets: watcher.targets.length };
      });
    const hand = await mouse(page);
    const samples = way.slice(0, Math.round(0.7 * way.length));
    await hand.play([[0, START.x, START.y]]);
    await hand.rest(REST);
    await hand.play(samples);
    await nextFrame(page);
    const top = await taking();
    await page.evaluate(() => (list.scrollTop = 30_000));
    await hand.play([[0, START.x, START.y]]);
    await hand.rest(REST);
    await page.evaluate(() => (reads.length = 0));
    await hand.play(samples);
    await nextFrame(page);
    const scrolled = await taking();
    const read = await page.evaluate(() => reads.length);
    await close();
    assert.deepEqual(top, { first: "t0", count: 20, targets: 5000 });
    assert.deepEqual(scrolled, { first: "t1000", count: 20, targets: 5000 });
    assert.ok(read < 2500, `${read} reads in a movement`);
  });
});
