// docs/react.md on a page's own tests: React in jsdom, where there is no layout and nothing is predicted.
import assert from "node:assert/strict";
import { it } from "node:test";
import { JSDOM } from "jsdom";
import { inNode, reactAliases } from "./support.mjs";

const program = `import { act, createElement as h, StrictMode, useState } from "react";
import { createRoot } from "react-dom/client";
import { Intent, IntentProvider, useIntent } from "whither/react";

function Port({ id }) {
  const { ref, intended } = useIntent({ onIntent: ({ reason }) => log.push([id, reason]), onRelease: ({ pressed }) => log.push([id, pressed]) });
  return h("a", { ref, id, href: "#" }, String(intended));
}
export default async function run() {
  const root = createRoot(document.getElementById("root"));
  await act(() => root.render(h(StrictMode, null, h(IntentProvider, null, h(Port, { id: "cowes" }), h(Port, { id: "ryde" })))));
  const texts = () => [...document.querySelectorAll("a")].map(({ textContent, dataset }) => [textContent, dataset.predicted]);
  const shown = [texts()];
  const step = async (does) => {
    await act(async () => {
      does();
      await new Promise((resolve) => setTimeout(resolve, 50));
    });
    shown.push(texts());
  };
  await step(() => document.querySelector("#cowes").focus());
  await step(() => document.querySelector("#ryde").dispatchEvent(new PointerEvent("pointerdown", { bubbles: true, composed: true, pointerType: "mouse" })));
  await act(() => root.unmount());
  return shown;
}
`;

it("React in jsdom: the focus and a press are intents, and React has nothing to warn of", async (t) => {
  const { window } = new JSDOM('<!doctype html><div id="root"></div>', { pretendToBeVisual: true, url: "http://localhost/" });
  const events = ["CustomEvent", "PointerEvent", "MutationObserver", "requestAnimationFrame", "cancelAnimationFrame"];
  const names = ["window", "document", "navigator", "HTMLElement", "HTMLIFrameElement", "Element", "Node", ...events];
  for (const name of names) Object.defineProperty(globalThis, name, { value: window[name], configurable: true });
  // what act waits with, which Node's own would keep this process alive for
  globalThis.MessageChannel = class {
    port1 = {};
    port2 = { postMessage: () => setImmediate(() => this.port1.onmessage()) };
  };
  Object.assign(globalThis, { IS_REACT_ACT_ENVIRONMENT: true, log: [] });
  const warned = t.mock.method(console, "error", () => {});
  const { default: run } = await inNode(program, { alias: reactAliases(19) });
  const shown = await run();
  window.close();
  assert.deepEqual(warned.mock.calls, []);
  assert.deepEqual(globalThis.log, [
    ["cowes", "focus"],
    ["ryde", "press"],
    ["ryde", true],
    ["cowes", false],
  ]);
  const [idle, meant] = [
    ["false", undefined],
    ["true", "true"],
  ];
  // a press begins and ends in one
  assert.deepEqual(shown, [
    [idle, idle],
    [meant, idle],
    [meant, idle],
  ]);
});
