/**
 * Icons that are a car's own, in the style of lucide's, which has none of them: on 24 x 24, with a line of 1.5. Tyre, beam and the P of the
 * parking aid are drawn after the tell-tales of ISO 2575.
 */
import type { IconNode } from "lucide";

const lines = (...paths: readonly string[]): IconNode => paths.map((d) => ["path", { d }]);

/** A tyre in section, flat where it stands, with an exclamation mark: the tell-tale of its pressure. */
export const TyrePressure: IconNode = lines(
  "M6.6 2.5C2.4 7.4 2.2 13.4 5 18h14c2.8-4.6 2.6-10.6-1.6-15.5",
  "M5.5 18v3.5",
  "M9.8 18v3.5",
  "M14.2 18v3.5",
  "M18.5 18v3.5",
  "M12 6v6",
  "M12 14.9h.01",
);

/** A headlamp whose beam is dipped. */
export const DippedBeam: IconNode = lines(
  "M13.2 5c4.6 0 8.3 3.1 8.3 7s-3.7 7-8.3 7c-1.2-2-1.9-4.4-1.9-7s.7-5 1.9-7Z",
  "m8.3 6.2-5.3 1.6",
  "m7.6 10.4-5.3 1.6",
  "m7.6 14.6-5.3 1.6",
  "m8.3 18.8-5.3 1.6",
);

/** A seat from the side, with its headrest. */
export const Seat: IconNode = [
  ["rect", { x: "3.6", y: "1.5", width: "4.8", height: "3.8", rx: "1.7" }],
  ...lines(
    "M6.3 7.6a2 2 0 0 0-2 2.4l1.5 7a3 3 0 0 0 2.9 2.4h9.6a2.4 2.4 0 0 0 0-4.8h-6.9l-1.2-5.2a2.3 2.3 0 0 0-2.2-1.8Z",
    "M7.5 22.5h12",
  ),
];

/** The P and the sound of the sensors. */
export const ParkingAid: IconNode = lines(
  "M4.5 19.5v-15h4.3a4.4 4.4 0 0 1 0 8.8H4.5",
  "M15.5 15.2a4.6 4.6 0 0 1 0 5.3",
  "M18.2 12.9a8.4 8.4 0 0 1 0 9.1",
  "M12.9 17.4v.9",
);

/** A steering wheel. */
export const SteeringWheel: IconNode = [
  ["circle", { cx: "12", cy: "12", r: "9.5" }],
  ["circle", { cx: "12", cy: "12.5", r: "2.3" }],
  ...lines("M2.8 10.2 9.8 12", "M21.2 10.2 14.2 12", "M12 14.8v6.6"),
];
