/** The depth of the water anywhere in the bay, from the distance to the coast, banks and a rough sea floor; below zero it is land. */
import { BANKS, COAST, distance, HARBOURS, INLAND, ISLANDS, type Place } from "./coast.ts";

const MAINLAND: readonly Place[] = [...COAST, ...INLAND];
/** How rough coast and sea floor are: waves of so many metres, the coast moved by so many. */
const ROUGHNESS = [
  { length: 6400, height: 900 },
  { length: 2600, height: 420 },
  { length: 1100, height: 190 },
] as const;
/** Around a harbour the coast is as it is drawn, so that no harbour is cut off. */
const DREDGED = 3200;

/** Metres of water. */
export function depth(place: Place): number {
  const shore = Math.min(...ISLANDS.map((island) => offshore(place, island)), offshore(place, MAINLAND));
  const near = Math.min(...HARBOURS.map((harbour) => distance(place, harbour))) / DREDGED;
  const away = (shore + Math.min(1, near * near) * rough(place)) / 1000;
  const bed = away < 0 ? 8 * away : 4 * away + 0.03 * away * away;
  const banks = BANKS.map((bank) => bank.height * Math.exp(-((distance(place, bank) / bank.reach) ** 2)));
  return away < 0 ? bed : Math.max(Math.min(bed, 3), bed - banks.reduce((sum, rise) => sum + rise, 0));
}

/** Metres from a ring of land, negative inside it. */
function offshore(place: Place, ring: readonly Place[]): number {
  let nearest = Infinity;
  let inside = false;
  let from = ring.at(-1) ?? place;
  for (const to of ring) {
    const [dx, dy] = [to.x - from.x, to.y - from.y];
    const along = ((place.x - from.x) * dx + (place.y - from.y) * dy) / (dx * dx + dy * dy);
    const share = Math.min(1, Math.max(0, along));
    nearest = Math.min(nearest, Math.hypot(place.x - from.x - share * dx, place.y - from.y - share * dy));
    if (from.y > place.y !== to.y > place.y && place.x < from.x + ((place.y - from.y) / dy) * dx) inside = !inside;
    from = to;
  }
  return inside ? -nearest : nearest;
}

/** Smooth noise, the same in every visit. */
function rough({ x, y }: Place): number {
  return ROUGHNESS.reduce((sum, { length, height }) => sum + height * lattice(x / length, y / length), 0);
}

/** From -1 to 1, between random values at the integers. */
function lattice(x: number, y: number): number {
  const [i, j] = [Math.floor(x), Math.floor(y)];
  const [u, v] = [ease(x - i), ease(y - j)];
  const lower = random(i, j) * (1 - u) + random(i + 1, j) * u;
  const upper = random(i, j + 1) * (1 - u) + random(i + 1, j + 1) * u;
  return lower * (1 - v) + upper * v;
}

function ease(t: number): number {
  return t * t * (3 - 2 * t);
}

/** From -1 to 1, for two integers. */
function random(i: number, j: number): number {
  let hash = Math.imul(i, 0x9e3779b1) ^ Math.imul(j, 0x85ebca6b);
  hash = Math.imul(hash ^ (hash >>> 15), 0x2c1b3c6d);
  hash = Math.imul(hash ^ (hash >>> 12), 0x297a2d39);
  return ((hash ^ (hash >>> 15)) >>> 0) / 0x7fffffff - 1;
}
