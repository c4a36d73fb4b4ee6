/**
 * What thresholds were worth to recorded hands: of each movement the first icon whose probability passes the threshold, before the pointer
 * is on it.
 */
import type { THRESHOLDS } from "./model/settings.ts";

export interface Row {
  readonly threshold: (typeof THRESHOLDS)[number];
  /** Movements, in percent: it is the icon that is pressed; it is another one. In the rest no icon passes. */
  readonly right: number;
  readonly wrong: number;
  /** The median milliseconds before the press, of those right. */
  readonly lead: number;
}

export interface RecordedSet {
  readonly name: string;
  readonly movements: number;
  readonly people: number;
  readonly rows: readonly Row[];
}

/** What printed the figures, and when. */
export const SOURCE = {
  command: "npm run evaluate -- --ours --thresholds freihaut_pointclick.jsonl bunch_mouse.jsonl sapimouse.jsonl",
  date: "30 November 2026",
};

const rows = (...figures: readonly (readonly [Row["threshold"], number, number, number])[]): readonly Row[] =>
  figures.map(([threshold, right, wrong, lead]) => ({ threshold, right, wrong, lead }));

export const RECORDED: readonly RecordedSet[] = [
  {
    name: "Freihaut, outward",
    movements: 882,
    people: 40,
    rows: rows(
      [0.5, 62.7, 37.3, 705],
      [0.6, 73.6, 26.4, 688],
      [0.7, 80.0, 20.0, 658],
      [0.8, 87.8, 12.2, 626],
      [0.85, 89.7, 9.9, 604],
      [0.9, 93.2, 5.8, 570],
      [0.95, 93.8, 2.9, 524],
    ),
  },
  {
    name: "BUNCH",
    movements: 1014,
    people: 19,
    rows: rows(
      [0.5, 58.9, 39.3, 655],
      [0.6, 68.3, 28.3, 640],
      [0.7, 71.6, 21.6, 624],
      [0.8, 75.1, 13.3, 608],
      [0.85, 72.8, 9.9, 593],
      [0.9, 66.2, 6.1, 578],
      [0.95, 47.3, 2.3, 578],
    ),
  },
  {
    name: "SapiMouse",
    movements: 4500,
    people: 90,
    rows: rows(
      [0.5, 53.0, 44.7, 445],
      [0.6, 60.1, 35.8, 429],
      [0.7, 66.4, 27.8, 407],
      [0.8, 71.9, 19.5, 384],
      [0.85, 73.8, 15.1, 366],
      [0.9, 74.1, 10.1, 349],
      [0.95, 67.6, 4.4, 316],
    ),
  },
];
