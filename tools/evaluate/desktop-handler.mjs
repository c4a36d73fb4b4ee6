// The part of ForesightJS that predicts, out of its own package. It needs no page: pointer events are plain objects, and its clock is
// `performance.now`, which is set to the time of an event while it is processed.
import { readdirSync, readFileSync } from "node:fs";
import { createRequire } from "node:module";
import { dirname, join } from "node:path";
import { pathToFileURL } from "node:url";

const folder = dirname(createRequire(import.meta.url).resolve("js.foresight"));
const file = readdirSync(folder).find((name) => /^DesktopHandler-.*\.mjs$/.test(name));
const { DesktopHandler } = await import(pathToFileURL(join(folder, file)));

export const { version } = JSON.parse(readFileSync(join(folder, "../package.json"), "utf8"));

/** The package's own defaults, without what needs a page. */
const DEFAULTS = {
  enableMousePrediction: true,
  enableScrollPrediction: false,
  enableTabPrediction: false,
  enableManagerLogging: false,
  trajectoryPredictionTime: 120,
  positionHistorySize: 8,
};

/**
 * Predicts among elements, `{ bounds: { expandedRect: { left, top, right, bottom } } }` each.
 *
 * @param settings - Other than its defaults.
 * @param elements - Those that are looked for; the set may change.
 * @param predicted - Called with what the extended line meets.
 */
export function desktopHandler(settings = {}, elements = new Set(), predicted = () => {}) {
  const handler = new DesktopHandler({
    settings: { ...DEFAULTS, ...settings },
    elements: new Map(),
    scannableElements: elements,
    callCallback: predicted,
    emit() {},
    hasListeners: () => false,
    updateElementBounds() {},
    updateElementState() {},
  });
  return {
    /** Takes in a place at a time in milliseconds, and gives the point that is predicted. */
    move(time, clientX, clientY) {
      const { now } = performance;
      performance.now = () => time;
      try {
        handler.processMouseMovement({ clientX, clientY });
      } finally {
        performance.now = now;
      }
      const { x, y } = handler.trajectoryPositions.predictedPoint;
      return [x, y];
    },
  };
}
