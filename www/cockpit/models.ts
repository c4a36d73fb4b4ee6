/** What predicts: the package's model of a hand, with and without `shake`, and the papers' methods as the papers set them up. */
import { handScenario, type Method, type Scenario } from "whither";
import { ICON, TARGETS } from "./cabin.ts";
import { TRACKED } from "./gesture.ts";

/** The largest amplitude of the road that is expected, in mm, where any is. */
const SHAKE = 20;
/** The prior probability that none of the icons is meant: about that of one icon more. */
const NONE = 0.05;

/** For a hand among the icons. */
export function handModel(shake: boolean, none = NONE): Scenario {
  return handScenario(TARGETS, { none, noise: TRACKED, shake: shake ? SHAKE : 0 });
}

/** Constant velocity in three dimensions: what `npm run reproduce` takes for the papers' experiments, in mm. */
export function paperModel(method: Exclude<Method, "pointing">): Scenario {
  return {
    method,
    motion: { type: "constantVelocity", dimensions: 3, noise: 1000 },
    observation: { noise: 3 },
    initial: { velocity: 1000 },
    arrival: { type: "uniform", from: 0.4, to: 1.6 },
    quadrature: { rule: "simpson", points: 15 },
    destinations: TARGETS.map(({ id, x, y }) => ({ id, center: [x, y, 0], size: ICON })),
  };
}
