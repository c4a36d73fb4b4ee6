/** Regions of a field on a grid, as closed rings: marching squares, joined. */
import type { Place } from "./coast.ts";

export type Ring = readonly Place[];

/** Values at `columns * rows` places, row by row from the south-west. */
export interface Field {
  readonly origin: Place;
  readonly step: number;
  readonly columns: number;
  readonly rows: number;
  readonly values: Float64Array;
}

/** Samples a function over a rectangle. */
export function sample(
  value: (place: Place) => number,
  { west, east, south, north }: { west: number; east: number; south: number; north: number },
  step: number,
): Field {
  const columns = Math.ceil((east - west) / step) + 1;
  const rows = Math.ceil((north - south) / step) + 1;
  const values = Float64Array.from({ length: columns * rows }, (_, index) =>
    value({ x: west + (index % columns) * step, y: south + Math.floor(index / columns) * step }),
  );
  return { origin: { x: west, y: south }, step, columns, rows, values };
}

/** The rings around what lies below `level`; outside the grid nothing does, so every ring closes. */
export function below(field: Field, level: number): Ring[] {
  const { columns, rows, values, origin, step } = field;
  const at = (i: number, j: number) =>
    i < 0 || j < 0 || i >= columns || j >= rows ? Infinity : (values[j * columns + i] ?? Infinity);
  const place = (i: number, j: number, k: number, l: number): Place => {
    const [one, other] = [at(i, j), at(k, l)];
    const share = Number.isFinite(one) && Number.isFinite(other) ? (level - one) / (other - one) : 0.5;
    return { x: origin.x + (i + share * (k - i)) * step, y: origin.y + (j + share * (l - j)) * step };
  };
  // from the edge where a segment begins to where it leads, what is below on its left
  const segments = new Map<string, { to: string; place: Place }>();
  for (let j = -1; j < rows; j += 1) {
    for (let i = -1; i < columns; i += 1) {
      const corners = [
        [i, j],
        [i + 1, j],
        [i + 1, j + 1],
        [i, j + 1],
      ] as const;
      const inside = corners.map(([k, l]) => at(k, l) < level);
      for (let corner = 0; corner < 4; corner += 1) {
        // the ring enters a cell where, going round it, what is below ends
        if (!inside[corner] || inside[(corner + 1) % 4]) continue;
        let end = corner + 1;
        while (!inside[(end + 1) % 4]) end += 1;
        const [one, other] = [corners[corner], corners[(corner + 1) % 4]] as const;
        const [last, next] = [corners[end % 4], corners[(end + 1) % 4]] as const;
        if (!one || !other || !last || !next) continue;
        segments.set(edge(one, other), { to: edge(last, next), place: place(...one, ...other) });
      }
    }
  }
  return joined(segments);
}

/** A name for the edge between two corners, whichever comes first. */
function edge([i, j]: readonly [number, number], [k, l]: readonly [number, number]): string {
  return i + j < k + l ? `${i},${j},${k},${l}` : `${k},${l},${i},${j}`;
}

function joined(segments: Map<string, { to: string; place: Place }>): Ring[] {
  const rings: Place[][] = [];
  for (const start of segments.keys()) {
    const ring: Place[] = [];
    let key = start;
    for (let segment = segments.get(key); segment; segment = segments.get(key)) {
      ring.push(segment.place);
      segments.delete(key);
      key = segment.to;
    }
    if (ring.length > 2) rings.push(ring);
  }
  return rings;
}
