/** A hundred vessels of one day, simulated from the bridging model, the same in every visit. */
import { BASIN, distance, HARBOURS, type Harbour } from "./coast.ts";
import { depth } from "./depth.ts";
import { Random } from "./random.ts";
import { bound, sail, type Pin, type Report } from "./sail.ts";

export interface Vessel {
  readonly name: string;
  /** Where it goes; null: past all harbours. */
  readonly harbour: Harbour | null;
  readonly reports: readonly Report[];
}

export const FLEET_SIZE = 100;
/** Of these, so many pass the bay without calling. */
const PASSING = 6;
/** The day's first departure, and the time over which departures are spread, in hours. */
const BEGINS = 6;
const SPREAD = 0.4;
/** Seconds between two reports of one vessel of the fleet. */
export const FLEET_INTERVAL = 60;
const FIRST = ["Grey", "Blue", "Swift", "Northern", "Silver", "Amber", "Little", "Old", "Bright", "Quiet"];
const SECOND = ["Heron", "Plover", "Curlew", "Tern", "Gannet", "Petrel", "Dunlin", "Osprey", "Avocet", "Kestrel"];

export function fleet(seed = 20): Vessel[] {
  const random = new Random(seed);
  return Array.from({ length: FLEET_SIZE }, (_, index) => {
    const passing = index % Math.floor(FLEET_SIZE / PASSING) === 7;
    const harbour = passing ? null : (HARBOURS[Math.floor(random.uniform() * HARBOURS.length)] ?? null);
    const departs = 3600 * (BEGINS + SPREAD * random.uniform());
    return { name: nameOf(index), harbour, reports: track(harbour, departs, random) };
  });
}

/** A vessel that would run aground is drawn again. */
function track(harbour: Harbour | null, departs: number, random: Random): Report[] {
  for (;;) {
    const pins = harbour ? inward(harbour, random) : past(random);
    const seed = Math.floor(random.between(0, 2 ** 32));
    const reports = sail(pins, { seed, departs, interval: FLEET_INTERVAL });
    if (reports.every((report) => depth(report) > 0 || (harbour && distance(report, harbour) < 2 * BASIN))) return reports;
  }
}

/** From somewhere off the coast to a harbour. */
function inward(harbour: Harbour, random: Random): Pin[] {
  const from = { x: random.between(-16_000, 16_000), y: random.between(-6500, 0) };
  const speed = random.between(5, 7.5);
  return bound(from, harbour, distance(from, harbour) / speed, random);
}

/** Across the mouth of the bay, one way or the other. */
function past(random: Random): Pin[] {
  const speed = random.between(5, 8);
  const side = random.uniform() < 0.5 ? -1 : 1;
  const [from, to] = [random.between(-4, 0), random.between(-8, -5)];
  const minutes = 72_000 / speed / 60;
  return [
    { minute: 0, place: [side * 31, from], velocity: [-side * speed, 0], spread: 500, speedSpread: 0.4 },
    { minute: minutes, place: [side * -41, to], velocity: [-side * speed, -0.5], spread: 900, speedSpread: 0.5 },
  ];
}

function nameOf(index: number): string {
  return `${FIRST[index % FIRST.length]} ${SECOND[(Math.floor(index / FIRST.length) + index) % SECOND.length]}`;
}
