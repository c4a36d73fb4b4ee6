// What is mounted, unmounted, watched and stopped leaves nothing behind.
import assert from "node:assert/strict";
import { describe, it } from "node:test";
import { movement } from "../browser/hand.mjs";
import { hosted, open, START } from "./aim.mjs";
import { mouse, nextFrame, REST } from "./support.mjs";

/** Functions of the page that mount and unmount so many rows; `refs` has them all, weakly. */
const ROWS = `<ul id="list" style="margin: 0; padding: 0"></ul><script>
  window.refs = [];
  window.frame = () => new Promise((resolve) => requestAnimationFrame(() => setTimeout(resolve)));
  window.mount = (count) => {
    const rows = Array.from({ length: count }, () => {
      const row = document.createElement("li");
      row.className = "target";
      return row;
    });
    list.append(...rows);
    refs.push(...rows.map((row) => new WeakRef(row)));
    return rows;
  };
</script>`;

describe("lifetime", () => {
  const site = hosted();

  /** What the browser counts once everything is collected that can be, and how many of `refs` are left. */
  async function left(page) {
    const session = await page.context().newCDPSession(page);
    for (let k = 0; k < 3; k++) {
      await page.evaluate(() => frame());
      await session.send("HeapProfiler.collectGarbage");
    }
    const { nodes, jsEventListeners: listeners } = await session.send("Memory.getDOMCounters");
    const rows = await page.evaluate(() => refs.filter((ref) => ref.deref() !== undefined).length);
    await session.detach();
    return { nodes, listeners, rows };
  }

  const way = movement(START, { x: 30, y: 90 }, 60, { seed: 9 });

  /** The pointer goes to the list and rests. */
  async function visit(hand) {
    await hand.play([[0, START.x + 400, START.y]]);
    await hand.rest(REST);
    await hand.play(way);
    await hand.rest(REST + 0.2);
  }

  it("ten times ten thousand rows come and go under a selector, and none is left", async () => {
    const { page, close } = await open(site, ROWS);
    const hand = await mouse(page);
    await visit(hand);
    const before = await left(page);
    for (let time = 0; time < 10; time++) {
      const mounted = await page.evaluate(async () => {
        mount(10_000);
        await frame();
        await frame();
        return watcher.targets.length;
      });
      assert.equal(mounted, 10_000);
      if (time % 5 === 0) await visit(hand);
      await page.evaluate(async () => {
        list.replaceChildren();
        await frame();
        await frame();
      });
    }
    await hand.play([[0, 900, 600]]);
    await nextFrame(page);
    assert.equal(await page.evaluate(() => watcher.targets.length), 0);
    assert.ok((await page.evaluate(() => predictions.filter(({ best }) => best !== null).length)) > 5);
    const after = await left(page);
    await close();
    assert.equal(after.rows, 0);
    assert.equal(after.listeners, before.listeners);
    assert.ok(after.nodes <= before.nodes + 100, `${before.nodes} nodes before, ${after.nodes} after`);
  });

  it("elements that were added are let go of when they are removed", async () => {
    const { page, close } = await open(site, ROWS, { watched: "[]" });
    const hand = await mouse(page);
    const added = await page.evaluate(() => {
      watcher.add(...mount(1000));
      return watcher.targets.length;
    });
    await visit(hand);
    await page.evaluate(async () => {
      watcher.remove(...list.children);
      await frame();
      list.replaceChildren();
    });
    await hand.play([[0, 900, 600]]);
    await nextFrame(page);
    const targets = await page.evaluate(() => watcher.targets.length);
    const after = await left(page);
    await close();
    assert.deepEqual([added, targets, after.rows], [1000, 0, 0]);
  });

  it("nothing is left after stop(), in the middle of a movement too", async () => {
    const first = `
      // before the watcher: what lives on every page
      window.observers = new Set();
      for (const name of ["MutationObserver", "IntersectionObserver", "ResizeObserver", "PerformanceObserver"]) {
        window[name] = class extends window[name] {
          observe(...given) { observers.add(this); return super.observe(...given); }
          disconnect() { observers.delete(this); return super.disconnect(); }
        };
      }
      mount(100);
      document.body.insertAdjacentHTML("beforeend", '<div id="host"></div>');
      host.attachShadow({ mode: "open" }).innerHTML = '<button class="target">In a shadow root</button>';
      window.startWatching = () => { window.watcher = whither.watch([...document.querySelectorAll(".target"),
        host.shadowRoot.querySelector("button")], { load: "eager" }); return watcher.ready; };`;
    // the first watcher is of nothing: it is there while the numbers of before are taken
    const { page, close } = await open(site, ROWS, { first, watched: "[]", options: "{ load: 'eager' }" });
    await page.evaluate(() => watcher.stop());
    const before = { ...(await left(page)), observers: await page.evaluate(() => observers.size) };
    await page.evaluate(() => startWatching());
    const during = { ...(await left(page)), observers: await page.evaluate(() => observers.size) };
    const hand = await mouse(page);
    await hand.play([[0, START.x, START.y]]);
    await hand.rest(REST);
    await hand.play(way.slice(0, Math.round(0.7 * way.length)));
    await nextFrame(page);
    const stopped = await page.evaluate(async () => {
      const moving = watcher.getSnapshot().moving;
      watcher.stop();
      window.released = [new WeakRef(watcher)];
      window.watcher = null;
      let frames = 0;
      const request = window.requestAnimationFrame;
      window.requestAnimationFrame = (callback) => (frames++, request(callback));
      await new Promise((resolve) => setTimeout(resolve, 300));
      window.requestAnimationFrame = request;
      const decorated = document.querySelectorAll("[data-predicted], [style*='--probability']").length;
      return { moving, frames, decorated, observers: observers.size };
    });
    const after = await left(page);
    const watchers = await page.evaluate(() => released.filter((ref) => ref.deref() !== undefined).length);
    await close();
    assert.ok(during.listeners > before.listeners, "listeners are counted");
    assert.ok(during.observers > before.observers, "observers are counted");
    assert.deepEqual(stopped, { moving: true, frames: 0, decorated: 0, observers: before.observers });
    assert.equal(after.listeners, before.listeners);
    assert.equal(watchers, 0);
  });

  it("a selector is live: what begins or ceases to match it is watched or not", async () => {
    const body = '<ul id="list"><li id="a" class="target"></li><li id="b"></li><li id="c" class="target"></li></ul>';
    const { page, close } = await open(site, body, { watched: '"#list > .target:not([data-done])"' });
    const ids = (change) =>
      page.evaluate(async (change) => {
        new Function(change)();
        await new Promise((resolve) => requestAnimationFrame(() => setTimeout(resolve)));
        return watcher.targets.map(({ id }) => id).join(" ");
      }, change);
    assert.equal(await ids(""), "a c");
    assert.equal(await ids('b.className = "target"'), "a b c");
    assert.equal(await ids('list.insertAdjacentHTML("afterbegin", "<li id=d class=target></li>")'), "d a b c");
    assert.equal(await ids("list.append(a)"), "d b c a");
    assert.equal(await ids("b.dataset.done = ''"), "d c a");
    assert.equal(await ids("c.remove()"), "d a");
    assert.equal(await ids('list.id = "other"'), "");
    await close();
  });

  it("a selector is live in a shadow root", async () => {
    const body = '<div id="host"><template shadowrootmode="open"><p class="target" id="a"></p></template></div>';
    const { page, close } = await open(site, body, { options: "{ root: host.shadowRoot }" });
    const ids = () =>
      page.evaluate(async () => {
        await new Promise((resolve) => requestAnimationFrame(() => setTimeout(resolve)));
        return watcher.targets.map(({ id }) => id).join(" ");
      });
    assert.equal(await ids(), "a");
    await page.evaluate(() => host.shadowRoot.firstElementChild.insertAdjacentHTML("afterend", "<p class=target id=b></p>"));
    assert.equal(await ids(), "a b");
    await page.evaluate(() => host.shadowRoot.replaceChildren());
    assert.equal(await ids(), "");
    await close();
  });
});
