import { handScenario, init, Predictor } from "whither";

await init();
// in mm from the screen's upper left corner
const size = { width: 24, height: 24 };
const icons = [
  { id: "radio", x: 20, y: 20, ...size },
  { id: "map", x: 220, y: 100, ...size },
];
const options = { none: 0.05, noise: 2, shake: 20 };
const predictor = new Predictor(handScenario(icons, options));

// for every frame of a tracker: the fingertip, z to the driver
export function onHand(seconds, [x, y, z]) {
  predictor.observe(seconds, [x, y, z]);
  return { ...predictor.best, ...predictor.remaining };
}
