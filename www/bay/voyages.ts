/** The voyages that are replayed, by the places that their vessels pass. */
import { HARBOURS, type Harbour } from "./coast.ts";
import { INTERVAL, sail, type Pin, type Report } from "./sail.ts";

export interface Voyage {
  readonly id: string;
  readonly name: string;
  /** Where it went in the end; null: to none of the harbours. */
  readonly harbour: Harbour | null;
  readonly reports: readonly Report[];
}

/** How a named voyage is made. */
interface Plan {
  readonly id: string;
  readonly name: string;
  /** Hours on the bay's clock. */
  readonly departs: number;
  readonly seed: number;
  readonly harbour: string | null;
  readonly pins: readonly Pin[];
}

const pin = (
  minute: number,
  place: readonly [number, number],
  velocity: readonly [number, number],
  spread = 300,
  speedSpread = 0.3,
): Pin => ({ minute, place, velocity, spread, speedSpread });

/** At a harbour, with little way on. */
function entry(minute: number, id: string, speed: number): Pin {
  const { x, y } = harbour(id);
  const length = Math.hypot(x, y);
  const velocity = [(speed * x) / length, (speed * y) / length] as const;
  return { minute, place: [x / 1000, y / 1000], velocity, spread: 150, speedSpread: 0.5 };
}

const PLANS: readonly Plan[] = [
  {
    id: "saltby",
    name: "To Saltby",
    departs: 13.1,
    seed: 11,
    harbour: "saltby",
    pins: [pin(0, [0.5, -3], [-3.7, 5.2]), entry(104, "saltby", 2)],
  },
  {
    id: "pellness",
    name: "To Pellness",
    departs: 6.4,
    seed: 5,
    harbour: "pellness",
    pins: [pin(0, [-6, -4], [6.6, 2.7]), entry(110, "pellness", 2)],
  },
  {
    id: "mind",
    name: "Changes its mind: Kelder, then Wrenmouth",
    departs: 9.25,
    seed: 3,
    harbour: "wrenmouth",
    pins: [pin(0, [1, -2], [4.6, 5]), pin(46, [14, 12], [4.7, 5.1]), pin(64, [15, 18], [-3, 4.4]), entry(130, "wrenmouth", 2)],
  },
  {
    id: "back",
    name: "Turns back at half way",
    departs: 15.6,
    seed: 8,
    harbour: null,
    pins: [
      pin(0, [2, -4], [-2.6, 6.3]),
      pin(52, [-5.5, 16], [-2.4, 6.4]),
      pin(58, [-6, 16.6], [2.6, -5.6]),
      pin(110, [2.5, -3], [2.7, -6.2]),
    ],
  },
  {
    id: "stops",
    name: "Stops, drifts, goes on",
    departs: 10.8,
    seed: 4,
    harbour: "tern-quay",
    pins: [
      pin(0, [-1, -3], [1.2, 6.4]),
      pin(48, [3, 15.5], [1.4, 6.4]),
      pin(52, [3.2, 16.2], [0, 0], 80, 0.02),
      pin(76, [3.25, 16.2], [0, 0], 40, 0.02),
      pin(81, [3.4, 16.9], [1.4, 5.6], 200, 0.2),
      entry(148, "tern-quay", 2),
    ],
  },
  {
    id: "none",
    name: "Goes to none of them",
    departs: 4.9,
    seed: 2,
    harbour: null,
    pins: [pin(0, [-30, -2], [6.2, 0.9]), pin(80, [1, 1], [6.4, -0.2], 900), pin(170, [38, -7.5], [6.6, -1.2], 800)],
  },
];

/** The named voyages, in the order in which they are offered. */
export function voyages(): Voyage[] {
  return PLANS.map(({ id, name, departs, seed, harbour: end, pins }) => ({
    id,
    name,
    harbour: end === null ? null : harbour(end),
    reports: sail(pins, { seed, departs: departs * 3600, interval: INTERVAL }),
  }));
}

function harbour(id: string): Harbour {
  const found = HARBOURS.find((one) => one.id === id);
  if (!found) throw new Error(`there is no harbour ${id}`);
  return found;
}
