/**
 * Where the focus is, and what is a few tab stops ahead of it.
 *
 * @module
 */
import type { Platform, Stop } from "./platform.js";

/** Finds the order of tab stops. */
export type FindTabStops = (container: Element, options: { getShadowRoot: true }) => readonly Element[];

/**
 * Follows the focus of a window until the returned function is called. `moved` gets the path of what has it, empty for nothing,
 * and the elements that are at tabs `tabs` stops ahead in the direction in which the user went; a focus that comes from a press is none.
 */
export function listenToFocus(
  platform: Platform,
  view: Window,
  tabs: number,
  moved: (path: readonly EventTarget[], ahead: readonly Element[]) => void,
  failed: (error: unknown) => void,
): Stop {
  let pressed = false;
  let direction = 0;
  let find: FindTabStops | null = null;
  if (tabs > 0) {
    platform.loadTabStops().then((loaded) => {
      find = loaded;
    }, failed);
  }
  const ahead = (focused: EventTarget | undefined): readonly Element[] => {
    if (direction === 0 || !find) return [];
    const stops = find(view.document.body, { getShadowRoot: true });
    const at = stops.indexOf(focused as Element);
    if (at < 0) return [];
    return direction > 0 ? stops.slice(at + 1, at + 1 + tabs) : stops.slice(Math.max(0, at - tabs), at).reverse();
  };
  return platform.listen(view, {
    pointerdown() {
      pressed = true;
    },
    keydown(event: KeyboardEvent) {
      pressed = false;
      direction = event.key !== "Tab" ? 0 : event.shiftKey ? -1 : 1;
    },
    focusin(event: FocusEvent) {
      const path = event.composedPath();
      if (!pressed) moved(path, ahead(path[0]));
    },
    focusout: () => moved([], []),
  });
}
