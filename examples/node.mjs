// Which harbour is a vessel going to? In Node, Deno or Bun: `npm install` the package, then `node node.mjs`.
import { init, Predictor } from "whither";

await init();
// metres and seconds; with positions in degrees, project them first
const vessel = new Predictor({
  motion: { type: "constantVelocity", dimensions: 2, noise: 0.3 },
  observation: { noise: 5 },
  initial: { velocity: 8 },
  arrival: { type: "uniform", from: 1200, to: 3600 },
  none: 0.05,
  destinations: [
    { id: "Cowes", center: [9000, 0], size: 400 },
    { id: "Portsmouth", center: [14000, 8000], size: 400 },
  ],
});
for (let minute = 0; minute < 10; minute++) {
  const time = 60 * minute;
  vessel.observe(time, [6 * time, 0.1 * time]);
  const { id, probability } = vessel.best;
  const arrival = vessel.arrival();
  console.log(`${minute} min: ${id} ${probability.toFixed(2)}, there after ${(arrival.mean / 60).toFixed(0)} min`);
}
vessel.free();
