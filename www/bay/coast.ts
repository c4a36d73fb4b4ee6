/** The bay: an invented coast, its islands and six harbours, in metres east and north of the pilot station. */

/** Metres east and north. */
export interface Place {
  readonly x: number;
  readonly y: number;
}

export interface Harbour extends Place {
  readonly id: string;
  readonly name: string;
  /** On which side of it there is room for its name. */
  readonly label: "left" | "right" | "above";
}

const kilometres = (points: readonly (readonly [number, number])[]): readonly Place[] =>
  points.map(([x, y]) => ({ x: 1000 * x, y: 1000 * y }));

/** What a chart shows at least. */
export const EXTENT = { west: -42_000, east: 42_000, south: -9000, north: 45_000 } as const;

/** Six, as in Liang et al., 35 to 40 km from the pilot station. */
export const HARBOURS: readonly Harbour[] = [
  { id: "orrin", name: "Orrin", x: -33_200, y: 13_000, label: "right" },
  { id: "saltby", name: "Saltby", x: -24_300, y: 28_800, label: "above" },
  { id: "wrenmouth", name: "Wrenmouth", x: -8000, y: 38_600, label: "above" },
  { id: "tern-quay", name: "Tern Quay", x: 11_000, y: 37_400, label: "above" },
  { id: "kelder", name: "Kelder", x: 26_600, y: 28_200, label: "above" },
  { id: "pellness", name: "Pellness", x: 34_800, y: 12_800, label: "left" },
];

/** Where pilots board and most voyages begin. */
export const PILOT_STATION: Place = { x: 0, y: 0 };

/** The coast from the west to the east; beyond its last point the land goes on in the north. */
export const COAST = kilometres([
  [-90, -6],
  [-62, -4],
  [-50, 1],
  [-44, 3],
  [-39, 4.5],
  [-36.2, 8],
  [-36.4, 11],
  [-34.6, 13.2],
  [-35, 16],
  [-32, 19.5],
  [-29, 22],
  [-27.6, 26],
  [-25.6, 29.8],
  [-23, 31.2],
  [-18.5, 31.5],
  [-15, 35],
  [-11.5, 37.6],
  [-8.4, 40.2],
  [-4.5, 40],
  [-1, 38.2],
  [1.8, 36],
  [4.5, 37.6],
  [8, 38],
  [11.2, 39],
  [14.5, 37.5],
  [18.5, 33.4],
  [22.5, 31.4],
  [25.5, 30.6],
  [28, 29],
  [29.2, 25.5],
  [30, 21.5],
  [33, 18.5],
  [35.5, 16],
  [36.2, 13],
  [37.8, 9.5],
  [42, 6],
  [50, 5],
  [66, -1],
  [90, -2],
]);

/** The rest of the land's outline, far outside every chart. */
export const INLAND = kilometres([
  [90, 120],
  [-90, 120],
]);

export const ISLANDS = [
  kilometres([
    [-41.4, -3.2],
    [-39.6, -1.4],
    [-37.4, -1.6],
    [-36.8, -3],
    [-38.6, -4.2],
  ]),
  kilometres([
    [1.5, 32.6],
    [2.1, 33.7],
    [3, 33.1],
    [2.5, 32.4],
  ]),
  kilometres([
    [19.2, 28],
    [19.4, 29.2],
    [20.6, 28.9],
    [20.4, 27.9],
  ]),
];

/** Banks that rise from the sea floor: so many metres in the middle, falling off over so many metres. */
export const BANKS = [
  { x: 17_000, y: 5500, height: 34, reach: 4600 },
  { x: -17_500, y: 10_500, height: 26, reach: 4200 },
  { x: -2000, y: 22_500, height: 22, reach: 3600 },
] as const;

/** What is written on the chart beside the harbours. */
export const NAMES: readonly (Place & { readonly text: string; readonly bay?: true })[] = [
  { text: "Ternhead Bay", x: 3000, y: 14_500, bay: true },
  { text: "Mare Bank", x: 17_000, y: 5500 },
  { text: "Gull Holm", x: -35_200, y: -5400 },
  { text: "The Sister", x: 6600, y: 31_800 },
];

export function distance(one: Place, other: Place): number {
  return Math.hypot(one.x - other.x, one.y - other.y);
}

/** The harbour whose basin holds a place, if any does. */
export function harbourAt(place: Place): Harbour | null {
  return HARBOURS.find((harbour) => distance(harbour, place) < BASIN) ?? null;
}

/** Within so many metres of its middle a vessel is in the harbour. */
export const BASIN = 900;
