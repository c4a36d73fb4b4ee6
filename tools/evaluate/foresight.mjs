// ForesightJS, through its own package: reads a track's samples a line ([[t, x, y], ...]), writes the predicted point
// after each of them.
import { createInterface } from "node:readline";
import { desktopHandler } from "./desktop-handler.mjs";

for await (const line of createInterface({ input: process.stdin })) {
  const handler = desktopHandler();
  const points = JSON.parse(line).map(([t, x, y]) => handler.move(1000 * t, x, y));
  process.stdout.write(`${JSON.stringify(points)}\n`);
}
