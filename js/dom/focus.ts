/**
 * Where the focus is, and what is a few tab stops ahead of it.
 *
 * @module
 */
import type { FindStopsAhead } from "./keyboard.js";
import type { Platform, Stop } from "./platform.js";

/**
 * Follows the focus of a window until the returned function is called. `moved` gets the path of what has it, empty for nothing,
 * and the elements that are at most `tabs` stops ahead in the direction in which the user went; a focus that comes from a press is
 * none.
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
  let ahead: FindStopsAhead = () => [];
  if (tabs > 0) {
    platform.loadKeyboard().then((loaded) => {
      ahead = loaded;
    }, failed);
  }
  return platform.listen(view, {
    pointerdown() {
      pressed = true;
    },
    keydown(event: KeyboardEvent) {
      pressed = false;
      direction = event.key !== "Tab" ? 0 : event.shiftKey ? -1 : 1;
    },
    focusin(event: FocusEvent) {
      const path = pressed ? [] : event.composedPath();
      moved(path, ahead(path[0], direction, tabs));
    },
    focusout({ relatedTarget }: FocusEvent) {
      // else it is elsewhere in this window, which is reported next
      if (!relatedTarget) moved([], []);
    },
  });
}
