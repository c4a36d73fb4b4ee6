import assert from "node:assert/strict";
import { describe, it } from "node:test";
import { readOptions } from "./options.js";
import type { Platform } from "./platform.js";
import { Presence } from "./presence.js";
import { type Exchange, Targets } from "./targets.js";
import { type Change, TestPage } from "./testing/page.js";
import type { WatchTargets } from "./types.js";

const BOX = { x: 0, y: 0, width: 40, height: 40 };

/** What is reported of targets on a page: `appeared` has which did, or disappeared, `changed` the records, `views` the windows listened to. */
function follow(page: TestPage, given: WatchTargets, platform: Platform = page) {
  const targets = new Targets(given, readOptions({ root: page.document }));
  const appeared: unknown[] = [];
  const changed: Change[] = [];
  const views: unknown[] = [];
  const presence = new Presence(platform, targets, {
    changed: (records) => changed.push(...records),
    visible: ({ node, visible }) => appeared.push([node, visible]),
    listen(view) {
      views.push(view);
      return () => views.splice(views.indexOf(view), 1);
    },
  });
  const take = ({ added, removed }: Exchange) => presence.watch(added, removed);
  presence.watch([...targets.all], []);
  const target = (node: unknown) => targets.find(node) as NonNullable<ReturnType<Targets["find"]>>;
  return { presence, targets, appeared, changed, views, take, target };
}

function open(): TestPage {
  return new TestPage({ core: () => assert.fail("no predictor is needed") });
}

/** A page as a platform, with other observers. */
function without(page: TestPage, observers: Partial<Platform>): Platform {
  return { window: page.window, visibility: () => null, mutations: () => null, ...observers } as Platform;
}

/** A same-origin frame's document. */
function framed() {
  const view = {};
  const document = { nodeType: 9, ownerDocument: null, defaultView: view };
  const element = { nodeType: 1, ownerDocument: document, getRootNode: () => document, closest: () => null };
  return { view, document, element: element as never as Element };
}

describe("presence: on the screen", () => {
  it("are elements from when the browser reports it, and virtual targets at once", () => {
    const page = open();
    const element = page.append("button", BOX);
    const virtual = { id: "v", bounds: () => BOX };
    const { target, appeared } = follow(page, [element, virtual]);
    assert.deepEqual([target(element).visible, target(virtual).visible], [false, true]);
    page.advance(20);
    assert.deepEqual([target(element).visible, appeared], [true, [[element, true]]]);
  });

  it("are all where nothing reports it", () => {
    const page = open();
    const element = page.append("button", BOX);
    assert.equal(follow(page, [element], without(page, {})).target(element).visible, true);
  });

  it("is reported when it changes, and then only; styles are to be read again", () => {
    const page = open();
    const element = page.append("button", BOX);
    const { target, appeared } = follow(page, [element]);
    page.advance(20);
    target(element).styled = true;
    page.show(element, true);
    assert.deepEqual([appeared.length, target(element).styled], [1, true]);
    page.show(element, false);
    assert.deepEqual([appeared.at(-1), target(element).styled], [[element, false], false]);
    page.show(element, true);
    assert.deepEqual([appeared.length, appeared.at(-1)], [3, [element, true]]);
  });

  it("is reported of targets that came later, and no longer of those that went", () => {
    const page = open();
    const [a, b] = [page.append("button", BOX), page.append("button", BOX)];
    const { targets, appeared, take } = follow(page, [a]);
    page.advance(20);
    take(targets.add([b]));
    take(targets.remove([a]));
    page.advance(20);
    page.show(a, false);
    page.show(b, false);
    assert.deepEqual(appeared, [
      [a, true],
      [b, true],
      [b, false],
    ]);
  });
});

describe("presence: in the tree", () => {
  it("changes are reported as the browser records them", () => {
    const page = open();
    const element = page.append("button", BOX);
    const { changed } = follow(page, [element]);
    element.setAttribute("class", "wide");
    page.append("i", BOX);
    assert.deepEqual(
      changed.map(({ type, attributeName }) => [type, attributeName]),
      [
        ["attributes", "class"],
        ["childList", undefined],
      ],
    );
  });

  it("are observed in every root that has targets, and in the main document, and no longer in those that have none", () => {
    const page = open();
    const frame = framed();
    let observed: Node[] = [];
    const mutations = () => ({ observe: (root: Node) => observed.push(root), disconnect: () => (observed = []) });
    const { targets, take } = follow(page, [], without(page, { mutations: mutations as never }));
    assert.deepEqual(observed, [page.document]);
    take(targets.add([frame.element]));
    assert.deepEqual(observed.length, 2);
    assert.ok(observed.includes(frame.document as never) && observed.includes(page.document));
    take(targets.remove([frame.element]));
    assert.deepEqual(observed, [page.document]);
  });
});

describe("presence: windows", () => {
  it("that have targets are listened to, each once, from the first time that this is asked for", () => {
    const page = open();
    const frame = framed();
    const element = page.append("button", BOX);
    const shadowed = page.append("button", BOX, { shadow: { host: element, mode: "open" } });
    const { presence, targets, views, take } = follow(page, [element, shadowed], without(page, {}));
    assert.deepEqual(views, []);
    presence.listen();
    assert.deepEqual(views, [page.window]);
    take(targets.add([frame.element]));
    assert.equal(views.length, 2);
    assert.equal(views[1], frame.view);
    take(targets.remove([frame.element]));
    assert.deepEqual(views, [page.window]);
    presence.listen();
    assert.deepEqual(views, [page.window]);
  });

  it("are listened to no longer while paused, whatever comes meanwhile", () => {
    const page = open();
    const frame = framed();
    const { presence, targets, views, take } = follow(page, [], without(page, {}));
    presence.listen();
    presence.deafen();
    take(targets.add([frame.element]));
    assert.deepEqual(views, []);
    presence.listen();
    assert.equal(views.length, 2);
  });

  it("and trees and the screen are observed no longer after the end", () => {
    const page = open();
    const element = page.append("button", BOX);
    const { presence, views, appeared, changed } = follow(page, [element]);
    presence.listen();
    page.advance(20);
    presence.stop();
    page.show(element, false);
    element.setAttribute("class", "wide");
    assert.deepEqual([views, appeared.length, changed, page.listening], [[], 1, [], 0]);
  });
});
