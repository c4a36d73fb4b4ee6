/** Samples of a pointer between two presses, cut into movements as `whither/dom` cuts them. */
import { contains, type Box, type Place, type Sample } from "./movement.ts";

/** Seconds without displacement that end a movement. */
const REST = 0.3;

/** The samples of one movement, and where the browser expected the pointer. */
export interface Recording {
  readonly samples: readonly Sample[];
  readonly expected: readonly (Place | null)[];
}

interface Entry {
  readonly time: number;
  readonly place: Place;
  expected: Place | null;
}

export class Recorder {
  /** Movements since the last press, each after a rest. */
  #parts: Entry[][] = [];
  #latest: Place | null = null;

  /**
   * A place at a time in seconds. Several places at one time are one sample, of the last; what is older than the last sample is
   * none, and a pointer that has not moved gives none.
   */
  add(time: number, x: number, y: number): void {
    const part = this.#parts.at(-1);
    const last = part?.at(-1);
    const entry: Entry = { time, place: [round(x), round(y)], expected: this.#latest };
    if (!part || !last) this.#parts.push([entry]);
    else if (time < last.time || isSame(last.place, entry.place)) return;
    else if (time === last.time) part[part.length - 1] = entry;
    else if (time - last.time > REST) {
      this.#latest = null;
      this.#parts.push([{ ...entry, expected: null }]);
    } else part.push(entry);
  }

  /** Where the browser expects the pointer, as of the last sample. */
  expect(place: Place): void {
    this.#latest = [round(place[0]), round(place[1])];
    const last = this.#parts.at(-1)?.at(-1);
    if (last) last.expected = this.#latest;
  }

  /**
   * The movement that led to a target, which begins anew after it: after the last rest outside of the target, so that neither a
   * rest before the press nor a hand that stirs on the target cuts it. Null where there was none.
   */
  take(target: Box): Recording | null {
    const parts = this.#parts;
    this.clear();
    let from = parts.length - 1;
    while (from > 0 && parts[from]?.[0] && contains(target, parts[from]?.[0]?.place ?? [0, 0])) from -= 1;
    const entries = parts.slice(Math.max(0, from)).flat();
    const start = entries[0]?.time ?? 0;
    if (entries.length < 2) return null;
    return {
      samples: entries.map(({ time, place }) => [Math.round(1e6 * (time - start)) / 1e6, ...place]),
      expected: entries.map(({ expected }) => expected),
    };
  }

  clear(): void {
    this.#parts = [];
    this.#latest = null;
  }

  /** What was recorded since the last rest. */
  get current(): readonly Sample[] {
    return (this.#parts.at(-1) ?? []).map(({ time, place }) => [time, ...place]);
  }
}

/** Whether a recording shows a browser that predicts. */
export function hasExpected({ expected }: Recording): boolean {
  return expected.some((place) => place !== null);
}

function isSame([ax, ay]: Place, [bx, by]: Place): boolean {
  return ax === bx && ay === by;
}

/** To a hundredth of a pixel. */
function round(x: number): number {
  return Math.round(100 * x) / 100;
}
