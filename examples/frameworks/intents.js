// One watcher for all elements that a framework hands to it: what is inserted later is watched, what is removed is let go. On a
// server it does nothing.
import { watch } from "whither/dom";

const wanted = new WeakMap(); // what is called for an element: the last that was given

export const watcher = watch("[data-intent]", {
  onIntent: (intent) => wanted.get(intent.target)?.onIntent?.(intent),
  onRelease: (release) => wanted.get(release.target)?.onRelease?.(release),
});

/** Calls `onIntent` and `onRelease` for an element; given again, it calls others. */
export function intend(element, options) {
  wanted.set(element, options);
  element.setAttribute("data-intent", "");
}

/** Watches an element no longer, while it may still be on the page: while it fades out, for one. */
export function forget(element) {
  element.removeAttribute("data-intent");
}
