import { init, Predictor } from "whither";

await init();
const vessel = new Predictor({
  motion: { type: "constantVelocity", dimensions: 2, noise: 0.05 },
  observation: { noise: 10 }, // metres and seconds throughout
  initial: { velocity: 6 },
  arrival: { type: "uniform", from: 3600, to: 9000 },
  none: 0.1,
  destinations: [
    { id: "Saltby", center: [-24300, 28800], size: 1000 },
    { id: "Kelder", center: [26600, 28200], size: 1000 },
  ],
});
for (let t = 0; t <= 1800; t += 30) vessel.observe(t, [-4 * t, 5 * t]);
console.log(vessel.best, vessel.none, vessel.remaining);
