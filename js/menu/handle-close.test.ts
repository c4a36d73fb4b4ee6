import assert from "node:assert/strict";
import { describe, it } from "node:test";
import { type HandleClose, handleCloseOn } from "./handle-close.js";
import { MenuPage } from "./testing/page.js";

/** Two references at the left and one floating element, open; `leave` is what `useHover` does when the pointer leaves a reference. */
function open() {
  const menu = new MenuPage();
  const references = [100, 200].map((y) => menu.append({ x: 0, y, width: 100, height: 40 })) as [Element, Element];
  const floating = menu.append({ x: 200, y: 100, width: 160, height: 200 });
  const closed: string[] = [];
  const child = { parentId: "this", context: { open: false } };
  const tree = { nodesRef: { current: [child] } };
  const event = (type: string, over: Element | null, x: number, y: number, relatedTarget: Element | null = null) =>
    ({ type, composedPath: () => [over], relatedTarget, clientX: x, clientY: y }) as unknown as MouseEvent;
  const leave = (
    handleClose: HandleClose,
    reference: Element,
    x: number,
    y: number,
    name = "close",
    to: Element | null = null,
  ) => {
    const elements = { domReference: reference, floating };
    let bound = true;
    const onClose = () => {
      bound = false;
      closed.push(name);
    };
    const handler = handleClose({ x, y, elements, nodeId: "this", tree, onClose });
    handler(event("mouseleave", reference, x, y, to));
    return async (over: Element | null, x: number, y: number) => {
      await menu.move(x, y);
      if (bound) handler(event("mousemove", over, x, y));
    };
  };
  return { menu, references, floating, closed, child, leave, make: () => handleCloseOn(menu.platform) };
}

describe("handleClose", () => {
  it("closes when the probability falls, and not while it is high", async () => {
    const { menu, references, closed, leave, make } = open();
    await menu.move(90, 120);
    const move = leave(make(), references[0], 101, 145);
    await move(null, 150, 170);
    assert.deepEqual(closed, []);
    menu.probability = 0.3;
    await move(null, 190, 190);
    assert.deepEqual(closed, ["close"]);
    assert.equal(menu.page.listening, 0);
  });

  it("holds nothing where the pointer goes straight to the floating element, or has come to it", async () => {
    const { menu, references, floating, closed, leave, make } = open();
    await menu.move(90, 120);
    leave(make(), references[0], 200, 120, "close", floating);
    assert.equal(menu.page.clock.pending, 0);
    const move = leave(make(), references[0], 101, 145);
    await move(null, 150, 170);
    assert.ok(menu.page.listening > 0);
    await move(floating, 220, 180);
    menu.page.advance(3000);
    assert.deepEqual([closed, menu.page.listening, menu.page.clock.pending], [[], 0, 0]);
  });

  it("closes by what useHover gave last, whichever render asked", async () => {
    const { menu, references, closed, leave, make } = open();
    await menu.move(90, 120);
    leave(make(), references[0], 101, 145, "first");
    const move = leave(make(), references[0], 101, 145, "second");
    menu.probability = 0;
    await move(null, 150, 170);
    await move(null, 190, 190);
    assert.deepEqual(closed, ["second"]);
  });

  it("serves one floating element of several references", async () => {
    const { menu, references, closed, leave, make } = open();
    await menu.move(90, 120);
    await leave(make(), references[0], 101, 145)(null, 150, 170);
    const move = leave(make(), references[1], 101, 220, "of the other");
    await move(null, 150, 230);
    assert.equal(menu.targets.find(({ prior }) => prior === 0.1)?.y, 220);
    menu.probability = 0;
    await move(null, 170, 260);
    await move(null, 190, 280);
    assert.deepEqual(closed, ["of the other"]);
  });

  it("closes nothing while something is open that opened out of it, and nothing that is closed already", async () => {
    const { menu, references, floating, closed, child, leave, make } = open();
    await menu.move(90, 120);
    menu.probability = 0;
    child.context.open = true;
    const move = leave(make(), references[0], 101, 145);
    await move(null, 150, 190);
    assert.deepEqual([closed, menu.page.listening], [[], 0]);
    child.context.open = false;
    await move(null, 160, 200);
    Object.assign(floating, { box: { x: 0, y: 0, width: 0, height: 0 } });
    menu.page.advance(3000);
    assert.deepEqual([closed, menu.page.listening, menu.page.clock.pending], [[], 0, 0]);
  });

  it("does nothing on a server, where it has its options all the same", () => {
    const handleClose = handleCloseOn(null, { blockPointerEvents: true });
    assert.equal(handleClose.__options.blockPointerEvents, true);
    handleClose({ x: 0, y: 0, elements: {}, onClose: () => assert.fail("nothing is open") })({} as MouseEvent);
  });
});
