// whither/menu's handleClose given to floating-ui's useHover, in React, in Chromium with its own mouse.
import assert from "node:assert/strict";
import { before, describe, it } from "node:test";
import { build } from "esbuild";
import { root } from "../../scripts/run.mjs";
import { movement } from "../browser/hand.mjs";
import { hosted, mouse, nextFrame, open, REST } from "./support.mjs";

const sleep = (seconds) => new Promise((resolve) => setTimeout(resolve, 1000 * seconds));

/** A menu of nested items as floating-ui's documentation builds them; what opens and closes is logged with its reason. */
const app = `
  import { autoUpdate, FloatingNode, FloatingTree, offset, useFloating, useFloatingNodeId, useFloatingParentNodeId, useHover,
    useInteractions } from "@floating-ui/react";
  import { createElement as h, StrictMode, useEffect, useRef, useState } from "react";
  import { createRoot } from "react-dom/client";

  const { handleClose, options, items } = window.setup;

  function Item({ name, inner }) {
    const [open, setOpen] = useState(false);
    const shown = useRef(false);
    const why = useRef("");
    useEffect(() => {
      if (open !== shown.current) log.push([open ? "open" : "close", name, why.current].join(" "));
      shown.current = open;
    }, [open]);
    const nodeId = useFloatingNodeId();
    const { refs, floatingStyles, context } = useFloating({
      nodeId,
      open,
      onOpenChange(next, event, reason) {
        why.current = reason;
        setOpen(next);
      },
      placement: "right-start",
      middleware: [offset(options.offset ?? 0)],
      whileElementsMounted: autoUpdate,
    });
    const blockPointerEvents = options.block ?? true;
    // written anew at each render, as users do; events of a busy machine come late
    const hover = useHover(context, { enabled: inner.length > 0, handleClose: handleClose({ blockPointerEvents, rest: 1000, bound: 5000 }) });
    const { getReferenceProps, getFloatingProps } = useInteractions([hover]);
    return h(FloatingNode, { id: nodeId },
      h("button", { id: name, ref: refs.setReference, className: "item", ...getReferenceProps() }, name),
      open && h("div", { ref: refs.setFloating, id: name + "-panel", className: "panel", style: floatingStyles, ...getFloatingProps() },
        inner.map(([name, inner = []]) => h(Item, { key: name, name, inner }))));
  }

  const all = h(FloatingTree, null, h("div", { id: "menu" }, items.map(([name, inner = []]) => h(Item, { key: name, name, inner }))));
  const tree = createRoot(document.querySelector("main"));
  tree.render(h(StrictMode, null, all));
  window.unmount = () => tree.unmount();
`;

const style = `<style>
  #menu { position: absolute; left: 250px; top: 200px; width: 180px; background: #eee }
  .item { display: block; width: 100%; height: 32px; border: 0; padding: 0; background: none }
  .panel { width: 200px; background: #cde; z-index: 1 }
</style>`;

const items = [
  ["a", [["a1"], ["a2"], ["a3"], ["a4", [["a41"], ["a42"], ["a43"]]], ["a5"], ["a6"]]],
  ["b", [["b1"], ["b2"]]],
  ["c", [["c1"], ["c2"]]],
  ["d"],
  ["e"],
];

describe("handleClose of whither/menu in floating-ui's useHover", () => {
  const site = hosted();
  let bundled;
  before(async () => {
    const { outputFiles } = await build({
      stdin: { contents: app, resolveDir: root },
      bundle: true,
      format: "iife",
      write: false,
      define: { "process.env.NODE_ENV": '"development"' },
    });
    bundled = outputFiles[0].text.replaceAll("</script", "<\\/script");
  });

  async function openApp(options = {}) {
    const opened = await open(site, "<main></main>", {
      head: style,
      script: `
        const { handleClose } = await import("./menu.js");
        const warm = whither.watch([], { load: "eager" });
        await warm.ready;
        warm.stop();
        Object.assign(window, { log: [], setup: { handleClose, options: ${JSON.stringify(options)}, items: ${JSON.stringify(items)} } });
        const script = document.createElement("script");
        script.textContent = await (await fetch("app.js.html")).text();
        document.body.append(script);
        while (!document.querySelector("#a")) await new Promise(requestAnimationFrame);`,
      pages: { "app.js.html": bundled },
    });
    const { page } = opened;
    return {
      ...opened,
      hand: await mouse(page),
      log: () => page.evaluate(() => log),
      until: (count) => page.waitForFunction((count) => log.length >= count, count, { timeout: 3000 }),
      middle: async (id) => {
        const { x, y, width, height } = await page.locator(`#${id}`).boundingBox();
        return { x: x + width / 2, y: y + height / 2 };
      },
    };
  }

  /** Rests on an item's right half. */
  async function restOn(page, hand, { x, y }) {
    await hand.play([
      [0, x + 30, y - 2],
      [0.02, x + 30, y],
    ]);
    await hand.rest(REST);
    await nextFrame(page);
    return { x: x + 30, y };
  }

  for (const seed of [1, 2, 3])
    it(`keeps a submenu open on the way to a low item, across siblings (hand ${seed})`, async () => {
      const { page, hand, log, middle, close } = await openApp();
      const from = await restOn(page, hand, await middle("a"));
      await hand.play(movement(from, await middle("a6"), 32, { seed }));
      await sleep(0.3);
      assert.deepEqual(
        (await log()).filter((entry) => !/ a4 /.test(entry)),
        ["open a hover"],
      );
      assert.equal(await page.evaluate(() => document.querySelector("#a6").matches(":hover")), true);
      await close();
    });

  it("lets go where the pointer turns away, and the item that it is on has its turn", async () => {
    const { page, hand, log, middle, close } = await openApp();
    const from = await restOn(page, hand, await middle("a"));
    await hand.play(movement(from, await middle("c"), 32, { seed: 4 }));
    await page.waitForFunction(() => log.at(-1) === "open c hover");
    assert.deepEqual((await log()).slice(0, 2), ["open a hover", "close a safe-polygon"]);
    await hand.play(movement(await middle("c"), { x: 440, y: 640 }, 60, { seed: 5 }));
    await page.waitForFunction(() => log.at(-1) === "close c safe-polygon");
    await close();
  });

  it("holds a far panel, and those inside one another, and lets go of all of them", async () => {
    const { page, hand, log, until, middle, close } = await openApp({ offset: 50 });
    const from = await restOn(page, hand, await middle("a"));
    const inner = await middle("a4");
    await hand.play(movement(from, inner, 32, { seed: 6 }));
    await until(2);
    await hand.rest(REST);
    await hand.play(movement(inner, await middle("a43"), 32, { seed: 7 }));
    await hand.rest(REST);
    assert.deepEqual(await log(), ["open a hover", "open a4 hover"]);
    await hand.play(movement(await middle("a43"), { x: 700, y: 660 }, 60, { seed: 8 }));
    await hand.play(movement({ x: 700, y: 660 }, { x: 60, y: 660 }, 60, { seed: 9 }));
    await until(4);
    const closed = (await log()).slice(2).map((entry) => entry.split(" ").slice(0, 2).join(" "));
    assert.deepEqual(closed, ["close a4", "close a"]);
    await close();
  });

  it("leaves nothing to be called when the floating element is closed by something else, or gone", async () => {
    const { page, hand, log, middle, close } = await openApp({ block: false });
    const from = await restOn(page, hand, await middle("a"));
    await hand.play(movement(from, await middle("a6"), 32, { seed: 10, share: 0.4 }));
    await page.evaluate(() => unmount());
    const before = await log();
    await sleep(1.3);
    assert.deepEqual(await log(), before);
    await close();
  });
});
