import assert from "node:assert/strict";
import { describe, it } from "node:test";
import { readOptions, type Settings } from "./options.js";
import { idOf, isGone, release, Targets } from "./targets.js";
import type { TestElement } from "./testing/element.js";
import { TestPage } from "./testing/page.js";
import type { VirtualTarget, WatchOptions, WatchTarget, WatchTargets } from "./types.js";

const BOX = { x: 0, y: 0, width: 40, height: 40 };

function open(): TestPage {
  return new TestPage({ core: () => assert.fail("no predictor is needed") });
}

function settingsOn(page: TestPage, options: WatchOptions = {}): Settings {
  return readOptions({ root: page.document, ...options });
}

function watched(page: TestPage, targets: WatchTargets, options?: WatchOptions): Targets {
  return new Targets(targets, settingsOn(page, options));
}

const nodes = (targets: Targets): WatchTarget[] => Array.from(targets.all, ({ node }) => node);
const ids = (targets: Targets) => Array.from(targets.all, idOf);
const shape = (id: string): VirtualTarget => ({ id, bounds: () => BOX });

/** Ids as the elements' `name` attributes have them. */
const named = { target: (node: WatchTarget) => ({ id: (node as Partial<Element>).getAttribute?.("name") ?? undefined }) };

describe("targets", () => {
  it("of a selector are those of its root, live: in the order of the document, the same object as long as they are watched", () => {
    const page = open();
    const [a, b] = [page.append("button", BOX), page.append("button", BOX)];
    page.append("div", BOX);
    const targets = watched(page, "button");
    assert.deepEqual(nodes(targets), [a, b]);
    const kept = targets.find(a);
    const c = page.append("button", BOX);
    page.remove(b);
    page.elements.reverse();
    assert.deepEqual(nodes(targets), [a, b]);
    const { added, removed } = targets.change({});
    assert.deepEqual(nodes(targets), [c, a]);
    assert.equal(targets.find(a), kept);
    assert.deepEqual([added.map(({ node }) => node), removed.map(({ node }) => node)], [[c], [b]]);
    assert.equal(targets.find(b), undefined);
  });

  it("of a selector are looked for in another root from then on", () => {
    const page = open();
    const parent = page.append("form", BOX) as never as TestElement;
    const inner = page.append("button", BOX, { parent });
    const outer = page.append("button", BOX);
    const targets = watched(page, "button");
    assert.deepEqual(nodes(targets), [inner, outer]);
    targets.change({ settings: settingsOn(page, { root: parent as never }) });
    assert.deepEqual(nodes(targets), [inner]);
  });

  it("are an element, a virtual target, or any iterable of both, each once", () => {
    const page = open();
    const element = page.append("button", BOX);
    const virtual = shape("v");
    for (const [given, expected] of [
      [element, [element]],
      [virtual, [virtual]],
      [new Set([virtual, element]), [virtual, element]],
      [
        [element, virtual, element],
        [element, virtual],
      ],
      [[], []],
    ] as const) {
      assert.deepEqual(nodes(watched(page, given as WatchTargets)), expected);
    }
  });

  it("have keys that no two of them share, also where ids of elements are the same", () => {
    const page = open();
    const attributes = { id: "twice" };
    const first = page.append("button", BOX, { attributes });
    page.append("button", BOX, { attributes });
    const targets = watched(page, "button");
    const keys = new Set(Array.from(targets.all, ({ key }) => key));
    page.remove(first);
    page.append("button", BOX, { attributes });
    targets.change({});
    for (const { key } of targets.all) keys.add(key);
    assert.deepEqual([keys.size, ids(targets)], [3, ["twice", "twice"]]);
  });

  it("on a path are in its order", () => {
    const page = open();
    const outer = page.append("a", BOX);
    const inner = page.append("b", BOX, { parent: outer as never });
    const other = page.append("i", BOX);
    const targets = watched(page, [outer, inner]);
    assert.deepEqual(
      targets.on([other, inner, outer, page.document, page.window]).map(({ node }) => node),
      [inner, outer],
    );
  });

  it("leave out what data-whither-ignore takes out, out of shadow trees too", () => {
    const page = open();
    const parent = page.append("div", BOX) as never as TestElement;
    const host = page.append("div", BOX, { parent });
    const ignored = page.append("button", BOX, { parent });
    const shadowed = page.append("button", BOX, { shadow: { host, mode: "open" } });
    const free = page.append("button", BOX);
    for (const given of ["button", [ignored, shadowed, free]]) {
      const targets = watched(page, given);
      assert.deepEqual(nodes(targets), [ignored, shadowed, free]);
      parent.setAttribute("data-whither-ignore", "");
      targets.change({});
      assert.deepEqual(nodes(targets), [free]);
      parent.removeAttribute("data-whither-ignore");
      targets.change({});
      assert.deepEqual(nodes(targets), [ignored, shadowed, free]);
    }
  });

  it("have their roots observed, and those around these; a selector's root also where nothing is in it", () => {
    const page = open();
    const host = page.append("div", BOX);
    const shadow = { host, mode: "open" } as const;
    const shadowed = page.append("button", BOX, { shadow });
    assert.deepEqual([...watched(page, [shadowed]).roots()], [shadow, page.document]);
    assert.deepEqual([...watched(page, "a").roots()], [page.document]);
    assert.deepEqual([...watched(page, shape("v")).roots()], []);
  });

  it("that are let go have no element any more", () => {
    const page = open();
    const element = page.append("button", BOX);
    const target = watched(page, element).find(element);
    assert.ok(target && !isGone(target));
    release(target);
    assert.deepEqual([isGone(target), target.element, target.node === element], [true, null, false]);
  });
});

describe("targets: add and remove", () => {
  it("take in more, also beside a selector, and what is watched already once", () => {
    const page = open();
    const [a, b] = [page.append("button", BOX), page.append("div", BOX)];
    const targets = watched(page, "button");
    assert.deepEqual(
      targets.add([b, a]).added.map(({ node }) => node),
      [b],
    );
    assert.deepEqual(nodes(targets), [a, b]);
  });

  it("leave out an element of a selector until it is added again", () => {
    const page = open();
    const [a, b] = [page.append("button", BOX), page.append("button", BOX)];
    const targets = watched(page, "button");
    assert.deepEqual(
      targets.remove([a], assert.fail).removed.map(({ node }) => node),
      [a],
    );
    targets.change({});
    assert.deepEqual(nodes(targets), [b]);
    targets.add([a]);
    targets.change({});
    assert.deepEqual(nodes(targets), [a, b]);
    assert.equal(targets.find(a)?.node, a);
  });

  it("do nothing to what is not watched, which may be added later", () => {
    const page = open();
    const stranger = page.append("div", BOX);
    const targets = watched(page, []);
    assert.deepEqual(targets.remove([stranger], assert.fail), { added: [], removed: [] });
    targets.add([stranger]);
    assert.deepEqual(nodes(targets), [stranger]);
  });
});

describe("targets: what holds for each", () => {
  it("is what the options have, what a function of it returns, and over both what was set", () => {
    const page = open();
    const [a, b] = [page.append("button", BOX), page.append("button", BOX)];
    const target = (node: WatchTarget) => (node === a ? { prior: 2, name: "A" } : null);
    const targets = watched(page, "button", { target });
    const settings = (node: WatchTarget) => targets.find(node)?.settings;
    assert.deepEqual([settings(a), settings(b)], [{ prior: 2, name: "A" }, {}]);
    targets.set(a, { prior: 3 });
    assert.deepEqual([settings(a), settings(b)], [{ prior: 3, name: "A" }, {}]);
    targets.change({ settings: settingsOn(page, { target: { prior: 7, name: "all" } }) });
    assert.deepEqual(
      [settings(a), settings(b)],
      [
        { prior: 3, name: "all" },
        { prior: 7, name: "all" },
      ],
    );
    targets.set(a, null);
    assert.deepEqual(settings(a), { prior: 7, name: "all" });
  });

  it("is kept while an element is away", () => {
    const page = open();
    const a = page.append("button", BOX);
    const targets = watched(page, "button");
    targets.set(a, { prior: 3 });
    page.remove(a);
    targets.change({});
    page.elements.push(a as never);
    targets.change({});
    assert.equal(targets.find(a)?.settings.prior, 3);
  });

  it("names it by what was given, else by the id of an element or a virtual target", () => {
    const page = open();
    const plain = page.append("button", BOX);
    const a = page.append("button", BOX, { attributes: { id: "a" } });
    const targets = watched(page, [plain, a, shape("v")]);
    assert.deepEqual(ids(targets), [undefined, "a", "v"]);
    targets.set(a, { id: "given" });
    assert.deepEqual(ids(targets), [undefined, "given", "v"]);
  });
});

describe("targets: errors", () => {
  it("have a code and a path", () => {
    const page = open();
    const virtual = (bounds: unknown) => ({ id: "v", bounds: () => bounds }) as never;
    for (const [given, code, path] of [
      ["nav a[", "out-of-range", "targets"],
      [5, "wrong-type", "targets"],
      [null, "wrong-type", "targets"],
      [[page.append("a", BOX), 5], "wrong-type", "targets[1]"],
      [{ bounds: () => BOX }, "missing-key", "targets.id"],
      [[{ id: 5, bounds: () => BOX }], "wrong-type", "targets[0].id"],
      [[{ id: "v" }], "missing-key", "targets[0].bounds"],
      [[{ id: "v", bounds: 5 }], "wrong-type", "targets[0].bounds"],
      [[virtual(null)], "missing-key", "targets[0].bounds().x"],
      [[virtual({ ...BOX, x: Number.NaN })], "not-finite", "targets[0].bounds().x"],
      [[virtual({ ...BOX, height: "5" })], "wrong-type", "targets[0].bounds().height"],
      [[shape("v"), shape("v")], "duplicate-id", "target.id"],
    ] as const) {
      assert.throws(() => watched(page, given as never), { name: "WhitherError", code, path }, `${code} at ${path}`);
    }
    const target = () => ({ prior: -1 });
    assert.throws(() => watched(page, "a", { target }), { code: "out-of-range", path: "target.prior" });
  });

  it("of add, set, remove and change change nothing", () => {
    const page = open();
    const row = (name: string) => page.append("button", BOX, { attributes: { name } });
    const a = row("a");
    row("b");
    const targets = watched(page, "button", named);
    const state = () => Array.from(targets.all, (target) => [target, target.node, target.settings]);
    const before = state();
    const unchanged = (run: () => void, code: string, path: string) => {
      assert.throws(run, { code, path });
      assert.deepEqual(state(), before);
    };
    unchanged(() => targets.add([shape("a")]), "duplicate-id", "target.id");
    unchanged(() => targets.add([shape("c"), 5 as never]), "wrong-type", "targets[1]");
    unchanged(() => targets.set(a, { id: "b" }), "duplicate-id", "target.id");
    unchanged(() => targets.set(a, { threshold: 2 }), "out-of-range", "options.threshold");
    unchanged(() => targets.set(shape("c"), { prior: 2 }), "unknown-id", "target");
    unchanged(() => targets.change({ settings: settingsOn(page, { target: { id: "all" } }) }), "duplicate-id", "target.id");
    unchanged(
      () => targets.change({ settings: settingsOn(page, { target: () => ({ prior: -1 }) }) }),
      "out-of-range",
      "target.prior",
    );
    targets.change({});
    assert.deepEqual(state(), before);
  });

  it("of others do not keep one from being removed: they are reported", () => {
    const page = open();
    const row = (name: string) => page.append("button", BOX, { attributes: { name } });
    const [a, b] = [row("a"), row("b")];
    const targets = watched(page, "button", named);
    const twin = row("b");
    const codes: unknown[] = [];
    targets.remove([a], (error) => codes.push((error as { code: string }).code));
    assert.deepEqual(codes, ["duplicate-id"]);
    assert.deepEqual(
      Array.from(targets.all, ({ node }) => node),
      [b, twin],
    );
  });

  it("of one among those that are found later are reported, and the others are taken in", () => {
    const page = open();
    const row = (name: string) => page.append("button", BOX, { attributes: { name } });
    const a = row("a");
    const targets = watched(page, "button", named);
    const [twin, c] = [row("a"), row("c")];
    const errors: { code: string; path: string }[] = [];
    const report = (error: unknown) => errors.push(error as never);
    targets.change({ report });
    assert.deepEqual(
      errors.map(({ code, path }) => [code, path]),
      [["duplicate-id", "target.id"]],
    );
    assert.deepEqual(nodes(targets), [a, twin, c]);
    assert.deepEqual(ids(targets), ["a", undefined, "c"]);
    targets.change({ report });
    assert.equal(errors.length, 1);
  });
});
