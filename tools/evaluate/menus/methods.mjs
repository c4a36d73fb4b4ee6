// What holds a panel open, each on a page without a browser on which a scene is replayed.
import { boundsOf } from "../intents/replay.mjs";
import { pretend, useHover } from "./use-hover.mjs";

/** Milliseconds on the page's clock before the first sample, with the pointer on the trigger. */
const BEFORE = 100;

/** Milliseconds after the last sample for which the pointer rests. */
const AFTER = 2000;

/** The values of `release` that are compared on the half of the users on which they were chosen. */
const RELEASES = { heldOpen: [0.15, 0.2, 0.25, 0.3, 0.4], handleClose: [0.3, 0.4, 0.5] };

/**
 * The methods by name: each `(page, elements, scene, closed)`, which begins to hold and returns `{ enter?, leave?, move?, stop? }`, what is done as
 * the pointer moves.
 *
 * @param menu - The files of js/menu, bundled: `heldOpenOn` and `handleCloseOn`.
 * @param tuned - Those of `RELEASES` in place of the others.
 */
export async function methodsOf({ heldOpenOn, handleCloseOn }, tuned) {
  pretend();
  const { safePolygon } = await import("@floating-ui/react");
  const hovering = (make) => (page, elements, scene, closed) => useHover(page, elements, scene.side, make(page), closed);
  const ours = {
    heldOpen: (options) => holding(heldOpenOn, options),
    handleClose: (options) => hovering((page) => handleCloseOn(platformOf(page), options)),
  };
  if (tuned) {
    const each = Object.entries(RELEASES).flatMap(([name, releases]) => releases.map((release) => [name, release]));
    return Object.fromEntries(each.map(([name, release]) => [`${name}, release ${release}`, ours[name]({ release })]));
  }
  return {
    heldOpen: ours.heldOpen(),
    handleClose: ours.handleClose(),
    safePolygon: hovering(() => safePolygon()),
    "safePolygon, requireIntent: false": hovering(() => safePolygon({ requireIntent: false })),
    "300 ms": delayed(300),
    "0 ms": delayed(0),
  };
}

/** The platform of js/menu that a test page is. */
function platformOf(page) {
  return {
    window: page.window,
    wait: (milliseconds, run) => page.wait(milliseconds, run),
    listen: (target, listeners) => page.listen(target, listeners),
    watch: (targets, options) => page.watch(targets, options),
    report(error) {
      throw error;
    },
  };
}

function holding(heldOpenOn, options) {
  return (page, { trigger, panel }, _scene, closed) => {
    const held = heldOpenOn(platformOf(page), trigger, panel, { ...options, onClose: ({ why }) => closed(why) });
    return {
      enter: (x, y) => trigger.dispatchEvent(Object.assign(new Event("pointerenter"), pointer, { clientX: x, clientY: y })),
      stop: () => held.stop(),
    };
  };
}

const pointer = { pointerId: 1, pointerType: "mouse", buttons: 0 };

/** Closes so many milliseconds after the pointer came off, unless it has come back. */
function delayed(milliseconds) {
  return (page, { trigger, panel }, _scene, closed) => {
    let stop = null;
    return {
      leave() {
        stop = page.wait(milliseconds, () => closed("delay"));
      },
      move(over) {
        if (over === trigger || over === panel) stop?.();
      },
      stop: () => stop?.(),
    };
  };
}

/** Replays a scene; returns when the panel was closed, in seconds from the first sample, and why, or null where it never was. */
export async function replay(scene, method, { Page, core }) {
  const page = new Page({ core });
  const append = (box) => measured(page.append("a", boundsOf(box)));
  const elements = { trigger: append(scene.trigger) };
  for (const box of scene.siblings) append(box);
  elements.panel = append(scene.panel);
  let outcome = null;
  const closed = (why) => (outcome ??= { time: (page.now() - BEFORE) / 1000, why });
  const holder = method(page, elements, scene, closed);
  const [[, startX, startY]] = scene.samples;
  holder.enter?.(startX, startY);
  await loaded();
  page.clock.advanceTo(BEFORE);
  let over = elements.trigger;
  for (const [time, x, y] of scene.samples) {
    page.clock.advanceTo(BEFORE + 1000 * time);
    if (outcome) break;
    const now = page.at(x, y);
    page.point("pointermove", x, y, { buttons: 0 });
    if (now !== over && (over === elements.trigger || over === elements.panel)) {
      holder.leave?.(over, x, y);
      await loaded();
    }
    holder.move?.(now, x, y);
    over = now;
  }
  if (!outcome) page.advance(AFTER);
  holder.stop?.();
  if (page.errors.length > 0) throw page.errors[0];
  return outcome;
}

/** What a watcher loads has been loaded before, so that it takes no time on the page's clock. */
function loaded() {
  return new Promise((resolve) => setImmediate(resolve));
}

/** An element of a test page that answers where it is as an element of a browser. */
function measured(element) {
  const { x, y, width, height } = element.box;
  const box = { x, y, width, height, left: x, top: y, right: x + width, bottom: y + height };
  return Object.assign(element, { getBoundingClientRect: () => box });
}
