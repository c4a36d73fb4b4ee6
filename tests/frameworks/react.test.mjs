// whither/react under the real mouse of Chromium, with React 18 and 19.
import assert from "node:assert/strict";
import { readFileSync } from "node:fs";
import { it } from "node:test";
import { join } from "node:path";
import { root } from "../../scripts/run.mjs";
import { calls, eachReact, logOf, until, watched } from "./react.mjs";
import { bundle, middle, open as openPage, REST, reach, reactAliases } from "./support.mjs";

eachReact(({ version, site, open }) => {
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
          h(IntentProvider, logged("provider"), h(Intent, { as: "button", id: "a", style: placed("a") }), shapes && h(Shapes)),
        );
      await show(true);
    });
    assert.deepEqual((await watched(page)).sort(), ["a", "port"]);
    await reach(page, hand, await middle(page, "#a"), { x: 880, y: 590, size: 60 });
    await until(page, () => log.some(({ kind, target }) => kind === "intent" && target === "port"));
    await page.evaluate(() => show(false));
    assert.deepEqual(await watched(page), ["a"]);
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
});
