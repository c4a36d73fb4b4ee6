/**
 * The intents as they come: when, of what, why, and how each ended.
 *
 * @module
 */
import { duration, make, percent, write } from "../elements.js";
import type { Entry, Log } from "../log.js";
import type { Subject } from "../subject.js";
import type { Part } from "./now.js";

/** `since` is when the overlay began, in milliseconds. */
export function intents(since: number): Part {
  const count = make("span", {});
  const list = make("ol", { tabIndex: 0, "aria-label": "Intents, the last first" });
  const empty = make("p", {}, "None yet.");
  const element = make(
    "details",
    { open: true },
    make("summary", {}, "Intents", count),
    make("div", { className: "inside" }, empty, list),
  );
  let items = new Map<Entry, ReturnType<typeof itemOf>>();
  let shown: readonly [Log, number] | null = null;
  return {
    element,
    update(subject) {
      const { log } = subject;
      if (shown?.[0] === log && shown[1] === log.revision) return;
      shown = [log, log.revision];
      write(count, String(log.count));
      empty.hidden = log.entries.length > 0;
      list.hidden = !empty.hidden;
      const known = items;
      items = new Map(log.entries.map((entry) => [entry, known.get(entry) ?? itemOf(entry, subject, since)]));
      for (const [entry, item] of known) if (!items.has(entry)) item.element.remove();
      let next: Element | null = list.firstElementChild;
      for (const item of items.values()) {
        if (item.element === next) next = next.nextElementSibling;
        else list.insertBefore(item.element, next);
        item.update();
      }
    },
  };
}

function itemOf(entry: Entry, subject: Subject, since: number) {
  const { target, time, reason, probability } = entry;
  const why = [reason ?? "", probability > 0 ? percent(probability) : ""].filter(Boolean).join(" ");
  const end = make("span", {});
  const element = make(
    "li",
    {},
    make("span", { className: "what" }, subject.nameOf(target)),
    end,
    make("small", {}, why),
    make("small", {}, `${((time - since) / 1000).toFixed(1)} s`),
  );
  return {
    element,
    update(): void {
      write(end, endOf(entry));
      if (entry.verdict) end.dataset["verdict"] = entry.verdict;
    },
  };
}

function endOf({ end, seconds, verdict }: Entry): string {
  if (!end) return "…";
  if (end === "released") return `left, ${duration(seconds)}`;
  // nothing had been meant before the press
  if (verdict === "unsure" || seconds === 0) return verdict === "wrong" ? "wrong" : "pressed";
  return verdict === "wrong" ? `wrong, ${duration(seconds)}` : `lead ${duration(seconds)}`;
}
