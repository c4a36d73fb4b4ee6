// Movements of the hand of whither/testing, as tracks: to places in all directions, from 100 to 500 px away.
import { hand } from "whither/testing";
import { randomOf } from "../intents/random.mjs";

const COUNT = 600;
const DISTANCES = [100, 500];

/** Sides of what is gone to (px). */
const SIZES = [24, 48];

/** The tracks, of a hand each; always the same. */
export function simulated() {
  return Array.from({ length: COUNT }, (_, seed) => {
    const random = randomOf(`simulated ${seed}`);
    const direction = 2 * Math.PI * random();
    const distance = DISTANCES[0] * (DISTANCES[1] / DISTANCES[0]) ** random();
    const size = SIZES[0] + (SIZES[1] - SIZES[0]) * random();
    const to = { x: distance * Math.cos(direction), y: distance * Math.sin(direction) };
    const samples = hand({ x: 0, y: 0 }, to, { size, seed, rate: 60 });
    return { id: `simulated-${seed}`, user: `simulated-${seed}`, targets: [[to.x, to.y, size, size]], target: 0, samples };
  });
}
