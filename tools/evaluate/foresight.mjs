// ForesightJS, through its own package: reads a track's samples a line ([[t, x, y], ...]), writes the predicted point
// after each of them. The package needs no page for this: its desktop handler takes pointer events as plain objects, and
// the clock that it reads is set to the sample's time.
import { readdirSync } from "node:fs";
import { createInterface } from "node:readline";
import { pathToFileURL } from "node:url";
import { createRequire } from "node:module";
import { dirname, join } from "node:path";

const folder = dirname(createRequire(import.meta.url).resolve("js.foresight"));
const file = readdirSync(folder).find((name) => /^DesktopHandler-.*\.mjs$/.test(name));
const { DesktopHandler } = await import(pathToFileURL(join(folder, file)));

let now = 0;
globalThis.performance.now = () => now;

// The package's own defaults.
const settings = {
  enableMousePrediction: true,
  enableScrollPrediction: false,
  enableTabPrediction: false,
  enableManagerLogging: false,
  trajectoryPredictionTime: 120,
  positionHistorySize: 8,
};

for await (const line of createInterface({ input: process.stdin })) {
  const handler = new DesktopHandler({
    settings,
    elements: new Map(),
    scannableElements: new Set(),
    callCallback() {},
    emit() {},
    hasListeners: () => false,
    updateElementBounds() {},
    updateElementState() {},
  });
  const points = [];
  for (const [t, clientX, clientY] of JSON.parse(line)) {
    now = 1000 * t;
    handler.processMouseMovement({ clientX, clientY });
    const { x, y } = handler.trajectoryPositions.predictedPoint;
    points.push([x, y]);
  }
  process.stdout.write(`${JSON.stringify(points)}\n`);
}
