// The program of the pages of react.mjs: React and whither/react in `kit`, and a log of what is called.
import * as React from "react";
import { flushSync } from "react-dom";
import { createRoot, hydrateRoot } from "react-dom/client";
import * as whither from "whither/react";

const h = React.createElement;

window.log = [];

/** Callbacks that write into the log. */
const logged = (name) => ({
  onIntent: ({ target, reason, signal, data }) => {
    const entry = { kind: "intent", name, target: target.id, reason, data, aborted: false };
    signal.addEventListener("abort", () => (entry.aborted = true));
    log.push(entry);
  },
  onRelease: ({ target, pressed }) => log.push({ kind: "release", name, target: target.id, pressed }),
});

const places = { a: [80, 80], b: [840, 80], c: [840, 560], x: [80, 300] };

/** Where one of three elements is, far apart from the others. */
const placed = (id) => {
  const [left, top] = places[id];
  return { position: "absolute", left, top, width: 80, height: 60 };
};

let root = null;

/** Renders in StrictMode, at once; the effects are over and what they ask for is done when it returns. */
async function render(element) {
  root ??= createRoot(document.getElementById("root"));
  flushSync(() => root.render(h(React.StrictMode, null, element)));
  await rendered();
}

/** Until React has done all that it is about to do, and what whither/react does after that. */
async function rendered() {
  for (let k = 0; k < 3; k++) await new Promise((resolve) => setTimeout(resolve));
}

async function unmount() {
  root?.unmount();
  root = null;
  await rendered();
}

/** An error boundary that keeps what it caught. */
class Boundary extends React.Component {
  state = { error: null };
  static getDerivedStateFromError(error) {
    return { error };
  }
  render() {
    const { error } = this.state;
    if (!error) return this.props.children;
    return h("p", { id: "caught" }, `${error.name} ${error.code} ${error.path}: ${error.message}`);
  }
}

window.kit = { ...React, ...whither, h, flushSync, createRoot, hydrateRoot, logged, placed, render, rendered, unmount, Boundary };
window.isReady = true;
