// When the layout is read, and what can be pointed at, on a page that counts its reads.
import assert from "node:assert/strict";
import { describe, it } from "node:test";
import { init, PointerPredictor } from "#pointing";
import type { TestElement } from "../testing/element.js";
import { TestPage } from "../testing/page.js";
import type { WatchOptions } from "../types.js";

await init();

/** A page with so many buttons in a row, and a pointer that goes along below them, one sample and one frame a step. */
async function open(count: number, options: WatchOptions = {}) {
  const page = new TestPage({ core: (targets, others) => new PointerPredictor(targets, others) });
  const buttons = Array.from({ length: count }, (_, i) => page.append("button", { x: 40 * i, y: 0, width: 20, height: 20 }));
  const watcher = page.watch("button", { load: "eager", ...options });
  await watcher.ready;
  page.advance(100);
  let x = 0;
  const step = () => {
    page.point("pointermove", (x += 8), 300);
    page.advance(1000 / 60);
  };
  for (let i = 0; i < 10; i++) step();
  const reads = (run: () => void) => {
    const before = page.reads.boxes;
    run();
    return page.reads.boxes - before;
  };
  return { page, buttons: buttons as (Element & TestElement)[], watcher, step, reads };
}

describe("layout", () => {
  it("is read in a handful of places in a frame, however many targets there are, and nowhere in an event", async () => {
    const { page, step, reads } = await open(1000);
    for (let i = 0; i < 20; i++) assert.ok(reads(step) <= 14, "in a frame");
    assert.equal(
      reads(() => page.point("pointermove", 900, 300)),
      0,
    );
  });

  it("is not read at all once the pointer rests, whatever changes", async () => {
    const { page, step, reads } = await open(50);
    step();
    page.advance(500);
    assert.equal(
      reads(() => {
        page.changed([{ type: "childList" }]);
        page.dispatch("resize", null);
        page.advance(500);
      }),
      0,
    );
  });

  it("is read of all targets when one of those that are probed has moved, or a change is reported", async () => {
    const { page, buttons, watcher, step, reads } = await open(200, { none: 0 });
    const leading = watcher.best?.target as Element & TestElement;
    leading.box = { ...leading.box, y: 5 };
    assert.ok(reads(step) >= 200, "of the most probable one");
    assert.ok(reads(step) < 20);
    page.dispatch("scroll", buttons[0] as Element);
    assert.ok(reads(step) >= 200, "of scrolling");
  });

  it("is not outdated by what a watcher writes, and is by other attributes", async () => {
    const { buttons, watcher, step, reads } = await open(200, { threshold: 0.001 });
    const button = buttons.at(-1) as Element & TestElement;
    step();
    assert.ok(watcher.getSnapshot().intended.length > 0, "marks were written");
    for (let i = 0; i < 10; i++) assert.ok(reads(step) < 20);
    button.setAttribute("class", "wide");
    assert.ok(reads(step) >= 200);
  });

  it("takes out in the next frame what is covered, outside of a modal, not usable or without an area, and takes it back", async () => {
    const { page, buttons, watcher, step } = await open(8);
    const target = watcher.best?.target as Element & TestElement;
    const none = (what: string) => {
      step();
      assert.equal(watcher.probability(target), 0, what);
      assert.notEqual(watcher.best?.target, target, what);
    };
    const back = (what: string) => {
      step();
      assert.ok(watcher.probability(target) > 0, `back from ${what}`);
    };
    const cover = page.append("div", target.box);
    none("covered");
    page.remove(cover);
    back("covered");
    const header = page.append("header", { ...target.box, y: 900 }) as Element & TestElement;
    back("nothing");
    for (const [y, covers] of [
      [target.box.y, true],
      [900, false],
    ] as const) {
      header.box = { ...header.box, y };
      page.dispatch("scroll", null);
      if (covers) none("scrolled under another");
      else back("under another");
    }
    const other = buttons.find((button) => button !== target) as Element & TestElement;
    page.modals.push(other);
    page.changed([{ type: "attributes", attributeName: "open" }]);
    none("modal");
    page.modals.pop();
    page.changed([{ type: "attributes", attributeName: "open" }]);
    back("modal");
    target.usable = false;
    page.changed([{ type: "childList" }]);
    none("unusable");
    target.usable = true;
    page.changed([{ type: "childList" }]);
    back("unusable");
    const { box } = target;
    target.box = { ...box, width: 0 };
    none("without an area");
    target.box = box;
    page.dispatch("resize", null);
    back("without an area");
  });

  it("leaves out targets with prior 0: where all have it, none of them is predicted", async () => {
    const { watcher, buttons, step, page } = await open(3, { target: { prior: 0 } });
    step();
    assert.deepEqual([watcher.best, watcher.none, watcher.getSnapshot().moving], [null, 1, true]);
    watcher.set(buttons[2] as Element, { prior: 2 });
    step();
    assert.equal(watcher.best?.target, buttons[2]);
    assert.deepEqual(page.errors, []);
  });
});
