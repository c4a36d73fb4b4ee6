// What ForesightJS calls back for on the same movements: a frame with the pointer's last place, as its manager has it.
import { desktopHandler, version } from "../desktop-handler.mjs";
import { isInside } from "./tracks.mjs";

/** How far ahead it extends the line (ms): its default, and others. */
const AHEAD = [120, 40, 80, 200];

export const SETTINGS = AHEAD.map((trajectoryPredictionTime) => ({ trajectoryPredictionTime }));

/** In place of the reasons. */
export const PEER = { name: `ForesightJS ${version}` };

/** The name of a row. */
export function nameOfSettings({ trajectoryPredictionTime: ahead }) {
  return `${ahead === AHEAD[0] ? "default: " : ""}trajectoryPredictionTime ${ahead}`;
}

/**
 * Registers the elements of a track, `null` for none, with each of the settings. An element is called back for once, as by default, and
 * nothing takes that back. What the movement begins on has been called back for before.
 *
 * @returns for each of the settings its `intents`, `[{ target, begin, end: null }]`, to which those to come are appended; `now` gives
 *   their times.
 */
export function register(page, { targets, samples }, elements, settings, now) {
  const each = settings.map((own) => {
    const intents = [];
    const entries = targets.flatMap((box, i) => (elements[i] && !isInside(samples[0], box) ? entryOf(elements[i], box) : []));
    const left = new Set(entries);
    const handler = desktopHandler(own, left, (entry) => {
      left.delete(entry);
      intents.push({ target: entry.element, begin: now(), end: null });
    });
    return { intents, handler };
  });
  let last = null;
  page.listen(page.window, {
    pointermove({ clientX, clientY }) {
      const isWaiting = last !== null;
      last = [clientX, clientY];
      if (isWaiting) return;
      page.frame(() => {
        for (const { handler } of each) handler.move(page.now(), ...last);
        last = null;
      });
    },
  });
  return each.map(({ intents }) => intents);
}

function entryOf(element, [x, y, width, height]) {
  const expandedRect = { left: x - width / 2, top: y - height / 2, right: x + width / 2, bottom: y + height / 2 };
  return { element, bounds: { expandedRect } };
}
