// whither/react in Chromium with React 18 and 19, under its real mouse: in StrictMode, with each call to whither/dom counted.
import assert from "node:assert/strict";
import { readFileSync } from "node:fs";
import { before, describe, it } from "node:test";
import { join } from "node:path";
import { root } from "../../scripts/run.mjs";
import { bundle, hosted, inNode, middle, nextFrame, open as openPage, REST, reach, reactAliases } from "./support.mjs";

/** In place of `whither/dom`: the same, with what is called kept in `watchers`. */
const counting = {
  name: "counting",
  setup({ onResolve, onLoad }) {
    const real = join(root, "dist/dom.js");
    onResolve({ filter: /^\.\/dom\.js$/ }, ({ importer }) =>
      importer.endsWith("react.js") ? { path: real, namespace: "counted" } : null,
    );
    onLoad({ filter: /./, namespace: "counted" }, () => ({
      resolveDir: join(root, "dist"),
      contents: `import { watch as begin } from "./dom.js";
        export * from "./dom.js";
        window.watchers = [];
        export function watch(...given) {
          const watcher = begin(...given);
          const calls = [];
          for (const name of ["add", "remove", "update", "set", "stop"]) {
            const own = watcher[name].bind(watcher);
            watcher[name] = (...given) => (calls.push([name, name === "update" ? Object.keys(given[0]) : given.length]), own(...given));
          }
          window.watchers.push({ watcher, calls });
          return watcher;
        }`,
    }));
  },
};

/** The calls of all watchers, `[["add", 3], ["update", ["threshold"]], ...]`: with how many nodes, or which options, they were about. */
const calls = (page) => page.evaluate(() => watchers.map(({ calls }) => calls));

/** The ids of what the one watcher that there is watches. */
const watched = (page) => page.evaluate(() => watchers.at(-1).watcher.targets.map(({ id }) => id));

/** What was logged, or of it what is about one target: where a hand rests before it moves, that is meant, too. */
const logOf = (page, id) => page.evaluate((id) => log.filter(({ target }) => id === undefined || target === id), id);
const until = (page, condition, argument) => page.waitForFunction(condition, argument, { timeout: 5000 });

describe("whither/react", { concurrency: 2 }, () => {
  for (const version of [18, 19]) {
    describe(`React ${version}`, () => {
      const site = hosted();
      let files;
      before(async () => {
        const kit = join(root, "tests/frameworks/react-kit.mjs");
        files = await bundle(kit, { alias: reactAliases(version), plugins: [counting] });
      });

      /** A page with the kit. */
      async function open(t, options) {
        const opened = await openPage(t, site, files, options);
        await opened.page.waitForFunction(() => window.isReady);
        assert.equal(await opened.page.evaluate(() => kit.version.split(".")[0]), String(version));
        return opened;
      }

      it("useIntent: renders again when the mouse is on its way, calls the last render's function, and again when it turns away", async (t) => {
        const { page, hand } = await open(t);
        await page.evaluate(async () => {
          const { h, useIntent, useState, placed } = kit;
          window.renders = { a: 0, b: 0, c: 0 };
          function Button({ id }) {
            const [count, setCount] = useState(0);
            const { ref, intended } = useIntent({
              hitSlop: { top: 0 },
              data: { id },
              onIntent: ({ data, reason }) => log.push(["intent", data.id, reason, count]),
              onRelease: ({ pressed }) => log.push(["release", id, pressed, count]),
            });
            renders[id] += 1;
            return h("button", { ref, id, style: placed(id), onClick: () => setCount(count + 1) }, `${intended} ${count}`);
          }
          await kit.render(["a", "b", "c"].map((id) => h(Button, { id, key: id })));
        });
        const [from, to] = [await middle(page, "#a"), await middle(page, "#c")];
        await hand.play([[0, from.x, from.y]]);
        await hand.press(from);
        await until(page, () => document.querySelector("#a").textContent.endsWith(" 1"));
        await page.evaluate(() => watchers[0].watcher.ready);
        await page.evaluate(() => log.splice(0));
        const before = await page.evaluate(() => ({ ...renders }));
        await reach(page, hand, from, to);
        await until(page, () => document.querySelector("#c").textContent === "true 0");
        assert.deepEqual((await logOf(page)).at(-1), ["intent", "c", "pointer", 0]);
        await reach(page, hand, to, { x: 120, y: 640, size: 40 });
        await until(page, () => document.querySelector("#c").textContent === "false 0");
        assert.deepEqual((await logOf(page)).at(-1), ["release", "c", false, 0]);
        const after = await page.evaluate(() => renders);
        assert.equal(after.b, before.b, "what is not meant is not rendered again");
        await reach(page, hand, { x: 120, y: 640 }, from);
        await hand.press(from);
        await until(page, () => document.querySelector("#a").textContent.endsWith(" 2"));
        assert.deepEqual((await logOf(page)).at(-1), ["release", "a", true, 1], "pressed, as the second render has it");
      });

      it("StrictMode: one watcher, each element added once in one call; nothing is left when they are gone", async (t) => {
        const { page, hand } = await open(t);
        const prepared = async (provider) => {
          const { h, Intent, IntentProvider, placed } = kit;
          const buttons = ["a", "b", "c"].map((id) => h(Intent, { as: "button", id, key: id, style: placed(id) }));
          await kit.render(provider ? h(IntentProvider, null, buttons) : buttons);
        };
        for (const [k, provider] of [false, true].entries()) {
          await page.evaluate(prepared, provider);
          assert.deepEqual((await calls(page))[k], [["add", 3]]);
          assert.deepEqual(await watched(page), ["a", "b", "c"]);
          await reach(page, hand, await middle(page, "#a"), await middle(page, "#c"));
          await until(page, () => document.querySelector("#c").dataset.predicted === "true");
          await page.evaluate(() => kit.unmount());
          assert.deepEqual((await calls(page))[k], [
            ["add", 3],
            ["stop", 0],
          ]);
          assert.equal(await page.evaluate(() => watchers.length), k + 1);
        }
      });

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

      it("options that change are taken over, those of an element and the provider's", async (t) => {
        const { page, hand } = await open(t);
        await page.evaluate(async () => {
          const { h, Intent, IntentProvider, placed, logged } = kit;
          window.show = (intent, options) => {
            const own = { c: { intent, ...logged(intent ? "own" : undefined) } };
            const button = (id) => h(Intent, { as: "button", id, key: id, style: placed(id), ...own[id] });
            return kit.render(h(IntentProvider, { ...options, ...logged("provider") }, ["a", "b", "c"].map(button)));
          };
          await show({ enabled: false }, { rest: 250 });
        });
        const [a, b, c] = [await middle(page, "#a"), await middle(page, "#b"), await middle(page, "#c")];
        await reach(page, hand, a, c);
        await hand.rest(REST);
        assert.deepEqual(await logOf(page, "c"), []);
        await page.evaluate(() => show({ data: "here" }, { rest: 250, threshold: 0.7 }));
        await page.evaluate(() => show({ data: "here" }, { threshold: 0.7 }));
        assert.deepEqual((await calls(page))[0], [
          ["add", 3],
          ["update", ["threshold"]],
          ["update", []],
          ["update", ["rest"]],
        ]);
        await reach(page, hand, a, c);
        await until(page, () => log.some(({ name, data }) => name === "own" && data === "here"));
        // where an element has no function of its own, the provider's is called
        await reach(page, hand, c, b);
        await until(page, () => log.some(({ kind, name, target }) => kind === "intent" && name === "provider" && target === "b"));
        const released = (await logOf(page, "c")).filter(({ kind }) => kind === "release");
        assert.ok(released.length > 0 && released.every(({ name }) => name === "own"));
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
        assert.deepEqual(
          given.called.filter((id) => id === "c").length,
          given.cleaned.length,
          "each clean-up of a ref was called",
        );
        assert.equal(given.called.filter((id) => id === null).length, given.called.filter((id) => id === "b").length);
      });

      it("an element that two components watch calls both, and belongs to the one that is left", async (t) => {
        const { page, hand } = await open(t);
        await page.evaluate(async () => {
          const { h, useIntent, Intent, forwardRef, useMergedRefs, logged, placed } = kit;
          const Inner = forwardRef(function Inner({ id, off }, forwarded) {
            const { ref, intended } = useIntent({ data: "inner", ...logged("inner") });
            const merged = useMergedRefs(forwarded, ref);
            return h("button", { ref: off ? forwarded : merged, id, style: placed(id) }, String(intended));
          });
          window.show = (off) =>
            kit.render([
              h(Intent, { as: Inner, off, id: "c", key: "c", ...logged("outer") }),
              h("button", { id: "a", key: "a", style: placed("a") }),
            ]);
          await show(false);
        });
        const [a, c] = [await middle(page, "#a"), await middle(page, "#c")];
        await reach(page, hand, a, c);
        await until(page, () => document.querySelector("#c").textContent === "true");
        assert.deepEqual(
          (await logOf(page))
            .slice(-2)
            .map(({ kind, name, data }) => [kind, name, data])
            .sort(),
          [
            ["intent", "inner", "inner"],
            ["intent", "outer", "inner"],
          ],
        );
        await page.evaluate(() => show(true));
        assert.equal(await page.locator("#c").textContent(), "false");
        await hand.press(c);
        await until(page, () => log.filter(({ pressed }) => pressed).length === 2);
        await page.evaluate(() => log.splice(0));
        await reach(page, hand, a, c);
        await until(page, () => log.length > 0);
        assert.ok((await logOf(page)).every(({ name }) => name === "outer"));
      });

      it("a component that goes while it is meant is given its release, and its signal aborts", async (t) => {
        const { page, hand } = await open(t);
        await page.evaluate(async () => {
          const { h, Intent, IntentProvider, logged, placed } = kit;
          const button = (id) => h(Intent, { as: "button", id, key: id, style: placed(id), ...logged(id) });
          const absent = { onIntent: undefined, onRelease: null, threshold: null, none: undefined };
          window.show = (...ids) => kit.render(h(IntentProvider, absent, ids.map(button)));
          await show("a", "c");
        });
        await reach(page, hand, await middle(page, "#a"), await middle(page, "#c"));
        const isLast = (kind) => log.findLast(({ target }) => target === "c")?.kind === kind;
        await until(page, isLast, "intent");
        await page.evaluate(() => show("a"));
        await until(page, isLast, "release");
        assert.deepEqual(
          (await logOf(page, "c")).slice(-2).map(({ kind, name, aborted, pressed }) => [kind, name, aborted ?? pressed]),
          [
            ["intent", "c", true],
            ["release", "c", false],
          ],
        );
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
        assert.equal(
          await caught({ treshold: 0.9 }).then((text) => text.slice(0, 42)),
          "WhitherError unknown-key treshold: treshol",
        );
        assert.match(
          await caught({ none: 1 }),
          /^WhitherError out-of-range none: none: must be at least 0 and less than 1, got 1$/,
        );
        assert.match(await caught({ target: {} }), /^WhitherError unknown-key target: target: unknown key "target"/);
        assert.match(
          await caught({ onIntent: "no" }),
          /^WhitherError wrong-type onIntent: onIntent: must be a function, got "no"$/,
        );
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

      it("usePrediction renders again for another value alone, and useWatcher has the one watcher", async (t) => {
        const { page, hand } = await open(t);
        await page.evaluate(async () => {
          const { h, Intent, usePrediction, useWatcher, placed } = kit;
          function Best() {
            const best = usePrediction(({ best }) => (best && best.probability > 0.5 ? best.id : null));
            const watcher = useWatcher();
            log.push([best, watcher && watchers.indexOf(watchers.find((one) => one.watcher === watcher))]);
            return h("output", null, String(best));
          }
          const buttons = ["a", "b", "c"].map((id) => h(Intent, { as: "button", id, key: id, style: placed(id) }));
          await kit.render([...buttons, h(Best, { key: "best" })]);
        });
        assert.equal(await page.locator("output").textContent(), "null");
        assert.deepEqual((await logOf(page)).at(-1), [null, 0]);
        await page.evaluate(() => log.splice(0));
        await reach(page, hand, await middle(page, "#a"), await middle(page, "#c"));
        await until(page, () => log.some(([best]) => best === "c"));
        await hand.rest(REST);
        await until(page, () => document.querySelector("output").textContent === "null");
        // each twice, as StrictMode has it
        const values = (await logOf(page)).map(([best]) => best).filter((_, k) => k % 2 === 0);
        assert.ok(
          values.every((best, k) => best !== (k === 0 ? "before" : values[k - 1])),
          `no value twice in a row: ${values}`,
        );
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

      it("what an Activity hides is not watched until it shows again", { skip: version < 19 }, async (t) => {
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

      it("useWatcher: shapes that are no elements are added to it, and given to the provider's functions", async (t) => {
        const { page, hand } = await open(t);
        await page.evaluate(async () => {
          const { h, Intent, IntentProvider, logged, placed, useEffect, useWatcher } = kit;
          const port = { id: "port", bounds: () => ({ x: 840, y: 560, width: 80, height: 60 }) };
          function Shapes() {
            const watcher = useWatcher();
            useEffect(() => {
              watcher?.add(port);
              return () => watcher?.remove(port);
            }, [watcher]);
            return null;
          }
          window.show = (shapes) =>
            kit.render(
              h(
                IntentProvider,
                logged("provider"),
                h(Intent, { as: "button", id: "a", style: placed("a") }),
                shapes && h(Shapes),
              ),
            );
          await show(true);
        });
        assert.deepEqual((await watched(page)).sort(), ["a", "port"]);
        await reach(page, hand, await middle(page, "#a"), { x: 880, y: 590, size: 60 });
        await until(page, () => log.some(({ kind, target }) => kind === "intent" && target === "port"));
        await page.evaluate(() => show(false));
        assert.deepEqual(await watched(page), ["a"]);
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

      it("the first example of docs/react.md asks for what the mouse is on its way to, and stops when it turns away", async (t) => {
        const [, example] = readFileSync(join(root, "docs/react.md"), "utf8").match(/```jsx\n(.*?)```/s);
        const program = `${example}
          import { createRoot } from "react-dom/client";
          const ports = ["Cowes", "Ryde", "Yarmouth"].map((name) => <Port key={name} id={name.toLowerCase()} name={name} />);
          createRoot(document.getElementById("root")).render(ports);`;
        const head = `<style>
          a { position: absolute; left: 80px; top: 80px; width: 80px; height: 60px }
          a:nth-child(2) { left: 840px } a:nth-child(3) { top: 560px } a.next { background: gold }
        </style>`;
        const { page, hand } = await openPage(t, site, await bundle(program, { alias: reactAliases(version) }), { head });
        const asked = [];
        await page.route("**/api/**", (route) => void asked.push(new URL(route.request().url()).pathname));
        const failed = page.waitForEvent("requestfailed");
        await page.waitForSelector("a");
        const [from, to] = [await middle(page, "a:nth-child(1)"), await middle(page, "a:nth-child(2)")];
        await reach(page, hand, from, to);
        await page.waitForSelector("a:nth-child(2).next");
        assert.equal(asked.at(-1), "/api/ports/ryde");
        await reach(page, hand, to, { x: 300, y: 650, size: 40 });
        assert.match((await failed).failure().errorText, /ABORTED/);
        await page.waitForFunction(() => document.querySelector(".next") === null);
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
  }
});
