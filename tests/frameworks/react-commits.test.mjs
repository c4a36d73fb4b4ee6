// What whither/react does in commits, with React 18 and 19: each call to whither/dom is counted.
import assert from "node:assert/strict";
import { it } from "node:test";
import { join } from "node:path";
import { root } from "../../scripts/run.mjs";
import { calls, eachReact, until, watched } from "./react.mjs";
import { bundle, inNode, middle, nextFrame, open as openPage, reach, reactAliases } from "./support.mjs";

eachReact(({ version, site, open }) => {
  it("new options, functions and refs at every render come to nothing", async (t) => {
    const { page } = await open(t);
    const renders = await page.evaluate(async () => {
      const { h, useIntent, usePrediction, useWatcher, useEffect, useState, IntentProvider, placed } = kit;
      let renders = 0;
      function Button({ id }) {
        const { ref } = useIntent({
          hitSlop: { left: 4 },
          data: { id, list: [1, { deep: 2 }] },
          onIntent: () => {},
          onRelease() {},
        });
        return h("button", { ref: (node) => ref(node), id, style: placed(id) });
      }
      function App() {
        const [count, setCount] = useState(0);
        renders += 1;
        useEffect(() => (count < 50 ? setCount(count + 1) : undefined), [count]);
        const best = usePrediction(({ targets }) => targets.map(({ id }) => ({ id })));
        const watcher = useWatcher();
        useEffect(() => void log.push(watcher), [watcher]);
        return h(
          "div",
          { title: best.length },
          ["a", "b", "c"].map((id) => h(Button, { id, key: id })),
        );
      }
      function Page() {
        const [, set] = useState(0);
        window.renderPage = () => kit.flushSync(() => set(Math.random()));
        const options = { limit: { running: 3 }, reasons: { hover: { after: 200 } }, pointers: ["mouse"] };
        return h(
          IntentProvider,
          { ...options, onIntent: () => {}, onPrediction: () => {}, onError: (error) => log.push(error) },
          h(App),
        );
      }
      await kit.render(h(Page));
      await new Promise((resolve) => setTimeout(resolve, 300));
      for (let k = 0; k < 10; k++) renderPage();
      await kit.rendered();
      return renders;
    });
    assert.deepEqual(await calls(page), [[["add", 3]]]);
    assert.ok(renders >= 51 && renders < 150, `${renders} renders of 51 states`);
    const known = await page.evaluate(() => log.filter((watcher) => watcher === watchers[0].watcher).length);
    assert.ok(known >= 1);
  });

  it("lists grow, are sorted and shrink: one call for each commit, and what is watched is what is there", async (t) => {
    const { page } = await open(t);
    await page.evaluate(async () => {
      const { h, useIntent } = kit;
      const Row = ({ id }) => h("li", { ref: useIntent({ prior: 2 }).ref, id });
      window.show = (ids) =>
        kit.render(
          h(
            "ul",
            null,
            ids.map((id) => h(Row, { id: `row-${id}`, key: id })),
          ),
        );
      window.ids = Array.from({ length: 1000 }, (_, id) => id);
      await show(ids);
      await show(ids.toReversed());
      await show(ids.filter((id) => id % 10 === 0));
      await show([...ids.filter((id) => id % 20 === 0), 2000, 2001]);
    });
    assert.deepEqual(await calls(page), [
      [
        ["add", 1000],
        ["remove", 900],
        ["remove", 50],
        ["add", 2],
      ],
    ]);
    const there = await page.evaluate(() => [...document.querySelectorAll("li")].map(({ id }) => id));
    assert.deepEqual((await watched(page)).sort(), there.sort());
    await page.evaluate(() => show([]));
    assert.deepEqual((await calls(page))[0].at(-1), ["stop", 0]);
  });

  it("refs: merged with those of the user, through forwardRef, classes and handles, on any component", async (t) => {
    const { page } = await open(t);
    const given = await page.evaluate(async () => {
      const { h, createRef, forwardRef, useImperativeHandle, useRef, useIntent, useMergedRefs, Intent, placed } = kit;
      window.refs = { object: createRef(), called: [], cleaned: [] };
      const Card = forwardRef(function Card({ id }, forwarded) {
        const own = useRef(null);
        const { ref } = useIntent({ data: "inner" });
        refs.own = own;
        return h("article", { ref: useMergedRefs(own, forwarded, ref, null, undefined), id, style: placed(id) });
      });
      const Shape = forwardRef(function Shape({ id }, ref) {
        useImperativeHandle(ref, () => ({ id, bounds: () => ({ x: 1, y: 2, width: 3, height: 4 }) }), [id]);
        return null;
      });
      const callback = (node) => refs.called.push(node?.id ?? null);
      const withCleanUp = (node) => (refs.called.push(node?.id ?? null), () => refs.cleaned.push("clean"));
      await kit.render([
        h(Intent, { as: Card, id: "a", key: "a", ref: refs.object, intent: { name: "outer" } }),
        h(Intent, { as: "button", id: "b", key: "b", ref: callback, style: placed("b") }),
        h(Intent, { as: Shape, id: "shape", key: "shape" }),
        h(Intent, { as: "a", href: "#", id: "c", key: "c", ref: withCleanUp, style: placed("c") }),
      ]);
      const targets = watchers[0].watcher.targets.map(({ id }) => id);
      const current = [refs.object.current?.id, refs.own.current?.id];
      await kit.unmount();
      return { targets, current, after: [refs.object.current, refs.own.current], called: refs.called, cleaned: refs.cleaned };
    });
    assert.deepEqual(given.targets.sort(), ["a", "b", "c", "shape"]);
    assert.deepEqual(given.current, ["a", "a"]);
    assert.deepEqual(given.after, [null, null]);
    assert.deepEqual(given.called.filter((id) => id === "c").length, given.cleaned.length, "each clean-up of a ref was called");
    assert.equal(given.called.filter((id) => id === null).length, given.called.filter((id) => id === "b").length);
  });

  it("wrong options: a provider's are thrown to the error boundary, an element's reported, and the others go on", async (t) => {
    const { page, problems } = await open(t);
    const caught = async (options) => {
      await page.evaluate(async (options) => {
        const { h, Boundary, IntentProvider } = kit;
        await kit.unmount();
        await kit.render(h(Boundary, null, h(IntentProvider, options, h("p", null, "fine"))));
      }, options);
      return page.locator("p").textContent();
    };
    assert.equal(await caught({ none: 0.1 }), "fine");
    assert.equal(await caught({ treshold: 0.9 }).then((text) => text.slice(0, 42)), "WhitherError unknown-key treshold: treshol");
    assert.match(await caught({ none: 1 }), /^WhitherError out-of-range none: none: must be at least 0 and less than 1, got 1$/);
    assert.match(await caught({ target: {} }), /^WhitherError unknown-key target: target: unknown key "target"/);
    assert.match(await caught({ onIntent: "no" }), /^WhitherError wrong-type onIntent: onIntent: must be a function, got "no"$/);
    // what React itself prints of errors that a boundary has caught
    problems.splice(0);
    const reported = await page.evaluate(async () => {
      const { h, IntentProvider, Intent, placed, Component } = kit;
      await kit.unmount();
      class Thing extends Component {
        render() {
          return null;
        }
      }
      window.errors = [];
      window.show = (prior, hitSlop = 3) =>
        kit.render(
          h(
            IntentProvider,
            { onError: ({ name, code, path, message }) => errors.push([name, code, path, message]) },
            h(Intent, { as: "button", id: "a", key: "a", style: placed("a"), intent: { prior } }),
            h(Intent, { as: "button", id: "b", key: "b", style: placed("b"), intent: { hitSlop } }),
            h(Intent, { as: Thing, key: "thing" }),
          ),
        );
      await show(-1);
      const first = [...errors.splice(0)];
      const watched = watchers.at(-1).watcher.targets.map(({ id }) => id);
      await show(-1);
      await show(2);
      const quiet = [...errors.splice(0)];
      await show(2, NaN);
      return { first, watched, quiet, last: errors };
    });
    assert.deepEqual(reported, {
      first: [
        ["WhitherError", "out-of-range", "target.prior", "target.prior: must be at least 0, got -1"],
        ["WhitherError", "missing-key", "targets[0].id", 'targets[0].id: missing key "id"'],
      ],
      watched: ["a", "b"],
      quiet: [],
      last: [["WhitherError", "not-finite", "target.hitSlop", "target.hitSlop: must be a finite number, got NaN"]],
    });
  });

  it("what is suspended is not watched until it is back", async (t) => {
    const { page } = await open(t);
    await page.evaluate(async () => {
      const { h, Suspense, Intent, placed, useState } = kit;
      const button = (id) => h(Intent, { as: "button", id, key: id, style: placed(id) });
      let waiting = null;
      const Waits = ({ on }) => {
        if (on && waiting !== false)
          throw (waiting ??= new Promise((resolve) => (window.go = () => ((waiting = false), resolve()))));
        return button("b");
      };
      function App() {
        const [on, set] = useState(false);
        window.suspend = () => kit.flushSync(() => set(true));
        return [button("a"), h(Suspense, { key: "s", fallback: button("c") }, button("x"), h(Waits, { on, key: "w" }))];
      }
      await kit.render(h(App));
    });
    assert.deepEqual(await watched(page), ["a", "x", "b"]);
    await page.evaluate(() => (suspend(), kit.rendered()));
    assert.deepEqual((await watched(page)).sort(), ["a", "c"]);
    await page.evaluate(() => (go(), new Promise((resolve) => setTimeout(resolve, 500))));
    assert.deepEqual((await watched(page)).sort(), ["a", "b", "x"]);
    assert.equal(await page.evaluate(() => watchers.length), 1);
    await nextFrame(page);
  });

  // React 18 has none
  if (version >= 19)
    it("what an Activity hides is not watched until it shows again", async (t) => {
      const { page } = await open(t);
      await page.evaluate(async () => {
        const { h, Activity, Intent, placed } = kit;
        const button = (id) => h(Intent, { as: "button", id, key: id, style: placed(id) });
        window.show = (mode) => kit.render([button("a"), h(Activity, { mode, key: "activity" }, button("b"))]);
        await show("visible");
      });
      for (const [mode, ids] of [
        ["visible", ["a", "b"]],
        ["hidden", ["a"]],
        ["visible", ["a", "b"]],
      ]) {
        await page.evaluate((mode) => show(mode), mode);
        assert.deepEqual(await watched(page), ids, mode);
      }
    });

  it("rows that come and go are let go of, and nothing listens when all are gone", async (t) => {
    const { page, hand } = await open(t);
    const session = await page.context().newCDPSession(page);
    const left = async () => {
      for (let k = 0; k < 3; k++) await session.send("HeapProfiler.collectGarbage");
      const { jsEventListeners } = await session.send("Memory.getDOMCounters");
      const rows = await page.evaluate(() => rowRefs.filter((ref) => ref.deref() !== undefined).length);
      return { listeners: jsEventListeners, rows };
    };
    await page.evaluate(async () => {
      const { h, useIntent } = kit;
      window.rowRefs = [];
      const Row = () => h("li", { ref: useIntent({ onIntent: () => {} }).ref });
      window.show = async (time, count) => {
        await kit.render(
          h(
            "ul",
            null,
            Array.from({ length: count }, (_, k) => h(Row, { key: `${time} ${k}` })),
          ),
        );
        rowRefs.push(...Array.from(document.querySelectorAll("li"), (row) => new WeakRef(row)));
      };
      await show(0, 0);
    });
    const before = await left();
    for (let time = 1; time <= 8; time++) {
      await page.evaluate((time) => show(time, 200), time);
      if (time === 1) await reach(page, hand, { x: 600, y: 600, size: 40 }, { x: 300, y: 50, size: 40 });
    }
    assert.ok((await left()).listeners > before.listeners, "listeners are counted");
    for (const time of [9, 10]) await page.evaluate((time) => show(time, 0), time);
    const after = await left();
    assert.equal(after.listeners, before.listeners);
    // React itself remembers the last rows, and those before
    assert.ok(after.rows <= 400, `${after.rows} of 1600 rows are left`);
  });

  it("is rendered on a server, where nothing is watched, and hydrated without a difference", async (t) => {
    const options = { alias: reactAliases(version) };
    const application = join(root, "tests/frameworks/react-server.mjs");
    const onServer = `import { renderToString } from "react-dom/server"; import { createElement } from "react";
      import { App } from "${application}";
      export const html = renderToString(createElement(App));`;
    const warned = t.mock.method(console, "error", () => {});
    const { html } = await inNode(onServer, options);
    assert.deepEqual(warned.mock.calls, [], "React has nothing to warn of");
    assert.match(html, /<a id="cowes" href="#cowes" class="other">Cowes<\/a>.*<p>not watching, resting<\/p>/);

    const onPage = `import { hydrateRoot } from "react-dom/client"; import { createElement } from "react";
      import { App } from "${application}";
      hydrateRoot(document.getElementById("root"), createElement(App), { onRecoverableError: (error) => console.error(error) });`;
    const style = "nav a { position: absolute; left: 80px; top: 80px } #ryde { left: 840px } #yarmouth { top: 560px }";
    const program = await bundle(onPage, options);
    const { page, hand } = await openPage(t, site, program, { body: html, head: `<style>${style}</style>` });
    await until(page, () => document.querySelector("p").textContent === "watching, resting");
    await reach(page, hand, await middle(page, "#cowes"), await middle(page, "#ryde"));
    await until(page, () => document.querySelector("#ryde").className === "next");
    assert.equal(await page.evaluate(() => document.querySelector("#ryde").dataset.predicted), "true");
  });
});
