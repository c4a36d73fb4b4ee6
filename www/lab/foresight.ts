/**
 * ForesightJS's rule, by the part of its own package that predicts, with its own defaults: the velocity over 8 samples, 120 ms
 * ahead. It needs no page: pointer events are plain objects, and its clock is `performance.now`, which is set to the time of
 * an event while it is processed.
 */
import { nearestTo } from "./peers.ts";
import { places, type Movement } from "./movement.ts";

interface Handler {
  processMouseMovement(event: { clientX: number; clientY: number }): void;
  readonly trajectoryPositions: { readonly predictedPoint: { readonly x: number; readonly y: number } };
}

interface HandlerModule {
  readonly DesktopHandler: new (dependencies: Record<string, unknown>) => Handler;
}

// its file's name has a hash in it, which no export of the package names
const files = import.meta.glob<HandlerModule>("../../node_modules/js.foresight/dist/DesktopHandler-*.mjs", { eager: true });
const [module] = Object.values(files);

const settings = {
  enableMousePrediction: true,
  enableScrollPrediction: false,
  enableTabPrediction: false,
  enableManagerLogging: false,
  trajectoryPredictionTime: 120,
  positionHistorySize: 8,
};

/** The target nearest to the point that it predicts. */
export function foresight(movement: Movement, length: number): number[] | null {
  if (!module) return null;
  const handler = new module.DesktopHandler({
    settings,
    elements: new Map(),
    scannableElements: new Set(),
    callCallback() {},
    emit() {},
    hasListeners: () => false,
    updateElementBounds() {},
    updateElementState() {},
  });
  const { now } = performance;
  try {
    return places(movement)
      .slice(0, length)
      .map(([clientX, clientY], k) => {
        performance.now = () => 1000 * (movement.samples[k]?.[0] ?? 0);
        handler.processMouseMovement({ clientX, clientY });
        const { x, y } = handler.trajectoryPositions.predictedPoint;
        return nearestTo([x, y], movement.targets);
      });
  } finally {
    performance.now = now;
  }
}
