/** A movement as a line, lit where the right target was on top. */
import { places, type Box, type Movement, type Place } from "./movement.ts";
import { points, svg } from "./svg.ts";
import type { Selection } from "./metrics.ts";

/** How places of one field are placed in another. */
export type Mapping = (place: Place) => Place;

export const AS_IT_IS: Mapping = (place) => place;

/** Targets within so many px of one another are the same ones. */
const NEAR = 4;

/** From targets to the same arrangement at another size; null where it is another one. */
export function mappingOf(from: readonly Box[], to: readonly Box[]): Mapping | null {
  if (from.length !== to.length || from.length === 0) return null;
  const [x, y] = ([0, 1] as const).map((axis) => {
    const [a, b] = [from, to].map((boxes) => extent(boxes, axis)) as [Extent, Extent];
    const scale = a.size > 0 ? b.size / a.size : 1;
    return (coordinate: number) => b.low + scale * (coordinate - a.low);
  }) as [(x: number) => number, (y: number) => number];
  const isSame = from.every((box, k) => {
    const other = to[k];
    return other && Math.hypot(x(box[0]) - other[0], y(box[1]) - other[1]) <= NEAR;
  });
  return isSame ? (place) => [x(place[0]), y(place[1])] : null;
}

interface Extent {
  readonly low: number;
  readonly size: number;
}

function extent(boxes: readonly Box[], axis: 0 | 1): Extent {
  const values = boxes.map((box) => box[axis]);
  const low = Math.min(...values);
  return { low, size: Math.max(...values) - low };
}

/** One line for each stretch with the right target on top, or another one; what follows the entry is thin. */
export function coloured(
  movement: Movement,
  tops: readonly (number | null)[],
  selected: readonly Selection[],
  mapping = AS_IT_IS,
): SVGElement {
  const path = places(movement).map(mapping);
  const kinds = path.map((_, k) => (k >= tops.length ? "after" : tops[k] === movement.target ? "right" : "other"));
  const lines: SVGElement[] = [];
  for (let from = 0; from < path.length - 1; ) {
    let to = from + 1;
    while (to < path.length - 1 && kinds[to] === kinds[from]) to += 1;
    lines.push(svg("polyline", { class: `path ${kinds[from]}`, points: points(path.slice(from, to + 1)) }));
    from = to;
  }
  const marks = selected.map(({ target, sample }) => {
    const [cx, cy] = path[sample] ?? [0, 0];
    return svg("circle", { class: `mark ${target === movement.target ? "right" : "other"}`, cx, cy, r: 5 });
  });
  return svg("g", {}, ...lines, ...marks);
}
