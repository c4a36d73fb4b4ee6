import assert from "node:assert/strict";
import { describe, it } from "node:test";
import { heldOpenOn } from "./held-open.js";
import { MenuPage } from "./testing/page.js";
import type { Closing, HeldOpenOptions } from "./types.js";

const TRIGGER = { x: 0, y: 100, width: 100, height: 40 };
const PANEL = { x: 200, y: 100, width: 160, height: 200 };

/** A trigger at the left and a panel 100 px from it, open; the mouse is on the trigger. */
async function open(options: Partial<HeldOpenOptions> = {}, panelBox = PANEL) {
  const menu = new MenuPage();
  const trigger = menu.append(TRIGGER);
  const panel = menu.append(panelBox);
  const closings: Closing[] = [];
  const held = heldOpenOn(menu.platform, trigger, panel, {
    onClose: (closing) => closings.push(closing),
    keep: () => false,
    ...options,
  });
  await menu.move(80, 120);
  return { menu, trigger, panel, held, closings, whys: () => closings.map(({ why }) => why) };
}

describe("a panel that is held open", () => {
  it("is held as long as the probability is high, and let go as soon as it is not", async () => {
    const { menu, held, closings } = await open();
    await menu.move(140, 170);
    assert.equal(held.held, true);
    assert.ok(Math.abs(held.probability - 0.9) < 1e-6, String(held.probability));
    menu.probability = 0.2;
    menu.at(150, 180);
    menu.page.advance(17);
    assert.deepEqual(
      closings.map(({ why, over }) => [why, over]),
      [["away", null]],
    );
    assert.ok(Math.abs((closings[0]?.probability ?? 0) - 0.2) < 1e-6);
    assert.deepEqual([held.held, held.probability], [false, 0]);
    await menu.move(600, 600);
    assert.equal(closings.length, 1);
    held.stop();
    assert.deepEqual([menu.page.listening, menu.page.clock.pending, menu.page.errors], [0, 0, []]);
  });

  it("is divided into cells, beside which the trigger is a target", async () => {
    const { menu, held } = await open();
    await menu.move(140, 170);
    const [trigger, ...cells] = menu.targets;
    assert.deepEqual([trigger?.x, trigger?.y, trigger?.prior], [50, 120, 0.1]);
    assert.equal(cells.length, 2 * 5);
    assert.deepEqual(
      cells.slice(0, 3).map(({ x, y, width, height, prior }) => [x, y, width, height, prior]),
      [
        [240, 120, 80, 40, 0.1],
        [320, 120, 80, 40, 0.1],
        [240, 160, 80, 40, 0.1],
      ],
    );
    held.stop();
  });

  it("is not held any more once the pointer has come to it, and is again when it leaves it", async () => {
    const { menu, held, whys } = await open();
    await menu.move(140, 170);
    await menu.move(250, 170);
    assert.equal(held.held, false);
    menu.page.advance(5000);
    assert.deepEqual(whys(), []);
    menu.probability = 0.1;
    await menu.move(250, 400);
    assert.deepEqual(whys(), ["away"]);
    held.stop();
  });

  it("is held for no longer than the bound", async () => {
    const { menu, held, whys } = await open({ bound: 200 });
    const begin = menu.page.now();
    await menu.move(110, 170);
    for (let i = 0; i < 100 && whys().length === 0; i++) await menu.move(110 + (i % 2) * 20, 180);
    assert.deepEqual(whys(), ["bound"]);
    assert.ok(menu.page.now() - begin < 300, String(menu.page.now() - begin));
    held.stop();
  });

  it("is let go where the pointer rests beside the way, and not between the two", async () => {
    for (const [y, expected] of [
      [170, ["rest"]],
      [130, []],
    ] as const) {
      const { menu, held, whys } = await open();
      await menu.move(150, y);
      menu.page.advance(500);
      assert.deepEqual(whys(), expected);
      menu.page.advance(1000);
      assert.equal(whys().length, 1);
      held.stop();
    }
  });

  it("is let go where the pointer sets out for nowhere, or leaves the window", async () => {
    const slow = await open();
    slow.menu.at(80, 143);
    slow.menu.page.advance(400);
    assert.deepEqual(slow.whys(), ["rest"]);
    slow.held.stop();
    const gone = await open();
    gone.menu.page.point("pointerout", 80, 120, { buttons: 0 });
    assert.deepEqual(gone.whys(), ["lost"]);
    gone.held.stop();
  });

  it("is held for 300 ms where there is no core", async () => {
    const menu = new MenuPage();
    const [trigger, panel] = [menu.append(TRIGGER), menu.append(PANEL)];
    const whys: string[] = [];
    const platform = { ...menu.platform };
    const watch = platform.watch;
    platform.watch = (targets, options) => Object.assign(watch(targets, options), { ready: new Promise(() => {}) });
    const held = heldOpenOn(platform, trigger, panel, { onClose: ({ why }) => whys.push(why), keep: () => false });
    menu.at(80, 120);
    menu.at(80, 150);
    menu.page.advance(299);
    assert.deepEqual(whys, []);
    menu.page.advance(2);
    assert.deepEqual(whys, ["unknown"]);
    held.stop();
  });

  it("stays as long as the page has it kept, and is asked about again", async () => {
    let kept = true;
    const { menu, held, whys } = await open({ keep: () => kept });
    menu.probability = 0;
    await menu.move(120, 400);
    assert.deepEqual(whys(), []);
    kept = false;
    await menu.move(300, 500);
    assert.deepEqual(whys(), ["away"]);
    held.stop();
  });

  it("takes no notice of fingers, of drags, and of a panel that is not open", async () => {
    const closed = await open({}, { ...PANEL, width: 0 });
    await closed.menu.move(140, 400);
    assert.equal(closed.held.held, false);
    assert.deepEqual(closed.whys(), []);
    closed.held.stop();

    const menu = new MenuPage();
    const [trigger, panel] = [menu.append(TRIGGER), menu.append(PANEL)];
    const held = heldOpenOn(menu.platform, trigger, panel, {
      onClose: () => assert.fail("nothing is closed"),
      keep: () => false,
    });
    const before = menu.page.listening;
    await menu.move(80, 120, { pointerType: "touch" });
    assert.equal(menu.page.listening, before);
    held.stop();

    const dragging = await open();
    await dragging.menu.move(250, 170);
    dragging.menu.probability = 0;
    await dragging.menu.move(250, 500, { buttons: 1 });
    assert.deepEqual(dragging.whys(), []);
    dragging.menu.page.point("pointerup", 250, 500, { buttons: 0 });
    await dragging.menu.move(250, 600);
    assert.deepEqual(dragging.whys(), ["away"]);
    dragging.held.stop();
  });

  it("is opened after a delay on the trigger, and not by a pointer that passes", async () => {
    let opened = 0;
    const { menu, panel, held } = await open({ delay: 100, onOpen: () => opened++ }, { ...PANEL, width: 0 });
    await menu.move(80, 200);
    menu.page.advance(200);
    assert.equal(opened, 0);
    await menu.move(80, 120);
    menu.page.advance(101);
    assert.equal(opened, 1);
    Object.assign(panel, { box: PANEL });
    await menu.move(60, 120);
    await menu.move(140, 150);
    assert.equal(held.held, true);
    held.stop();
  });

  it("reports what callbacks throw, and goes on", async () => {
    const errors: unknown[] = [];
    const onClose = () => {
      throw new Error("of the page");
    };
    const { menu, held } = await open({ onClose, onError: (error) => errors.push(String(error)) });
    menu.probability = 0;
    await menu.move(120, 400);
    assert.deepEqual(errors, ["Error: of the page"]);
    held.stop();
  });

  it("changes options, all of them or none, and stops with a signal", async () => {
    const controller = new AbortController();
    const { menu, held, whys } = await open({ signal: controller.signal });
    assert.throws(() => held.update({ release: 0.1, bound: -1 }), { path: "bound" });
    held.update({ release: 0.95 });
    await menu.move(140, 170);
    assert.deepEqual(whys(), ["away"]);
    await menu.move(80, 120);
    assert.ok(menu.page.listening > 0);
    controller.abort();
    assert.equal(menu.page.listening, 0);
  });

  it("does nothing on a server", () => {
    const held = heldOpenOn(null, {} as Element, {} as Element, { onClose() {} });
    held.update({});
    held.stop();
    assert.deepEqual([held.held, held.probability], [false, 0]);
  });
});
