// An application with whither/react, as a server and a page have it.
import * as React from "react";
import { Intent, IntentProvider, useIntent, useIntentRef, usePrediction, useWatcher } from "whither/react";

const h = React.createElement;

function Port({ id, name }) {
  const { ref, intended } = useIntent({ id, onIntent: () => {} });
  return h("a", { ref, id, href: `#${id}`, className: intended ? "next" : "other" }, name);
}

function State() {
  const watcher = useWatcher();
  const moving = usePrediction(({ moving }) => moving);
  return h(
    "p",
    { ref: useIntentRef({ enabled: false }) },
    `${watcher ? "watching" : "not watching"}, ${moving ? "moving" : "resting"}`,
  );
}

export function App() {
  const ports = ["Cowes", "Ryde", "Yarmouth"].map((name) => h(Port, { id: name.toLowerCase(), name, key: name }));
  const button = h(Intent, { as: "button", id: "all", intent: { hitSlop: 4 }, onIntent: () => {} }, "All");
  return h(React.StrictMode, null, h(IntentProvider, { threshold: 0.9 }, h("nav", null, ports), button, h(State)));
}
