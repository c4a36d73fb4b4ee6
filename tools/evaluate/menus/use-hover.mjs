// How floating-ui's useHover calls its `handleClose`, on a page without a browser: what is held open by one, such as safePolygon, the code of
// the package, whose clock and timers are then the page's.

/** The page whose clock and timers are read: one at a time. */
let page = null;
const timers = new Map();
const { clearTimeout } = globalThis;
let count = 0;

/** Gives code that was made for a browser the clock and the timers of a page; to be called before that code is imported. */
export function pretend() {
  globalThis.Element ??= class {};
  globalThis.window ??= {
    Element,
    setTimeout(run, milliseconds) {
      const id = `on the page ${count++}`;
      timers.set(id, page.wait(milliseconds, run));
      return id;
    },
  };
  globalThis.clearTimeout = (id) => {
    if (!timers.has(id)) return clearTimeout(id);
    timers.get(id)();
    return timers.delete(id);
  };
  const now = performance.now.bind(performance);
  performance.now = () => page?.now() ?? now();
}

/**
 * Holds a panel open on a page as `useHover` does with this `handleClose`.
 *
 * @param elements - The `trigger` and the `panel`, of the page.
 * @param side - The side of the trigger that the panel is on, as `placement`.
 * @returns what is to be called as the pointer moves, with what it is over (null: nothing): `leave` when it comes off one of the two, `move` at
 *   every place; and what ends it.
 */
export function useHover(on, { trigger, panel }, side, handleClose, onClose) {
  page = on;
  const elements = { domReference: trigger, floating: panel };
  let handler = null;
  const close = () => {
    handler = null;
    onClose();
  };
  const event = (type, element, x, y) => {
    return { type, clientX: x, clientY: y, composedPath: () => [element ?? page.document], relatedTarget: null };
  };
  const begin = (x, y) => handleClose({ x, y, placement: side, elements, nodeId: undefined, tree: null, onClose: close });
  return {
    leave(element, x, y) {
      if (element === trigger) handler = begin(x, y);
      // both are called when a trigger is left, the second one with this event
      begin(x, y)(event("mouseleave", element, x, y));
    },
    move(element, x, y) {
      handler?.(event("mousemove", element, x, y));
    },
    stop() {
      for (const stop of timers.values()) stop();
      timers.clear();
      page = null;
    },
  };
}
