import { handScenario, init, Predictor } from "whither";

await init();
// mm from the screen's upper left corner, z towards the driver
export function whereTo(icons, samples) {
  const options = { none: 0.05, noise: 2, shake: 20 };
  const predictor = new Predictor(handScenario(icons, options));
  for (const [seconds, x, y, z] of samples) {
    predictor.observe(seconds, [x, y, z]);
  }
  return { ...predictor.best, ...predictor.remaining };
}
