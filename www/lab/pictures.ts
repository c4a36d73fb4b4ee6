/** The pictures of one method: the last movement, the methods along it, the right share over time, calibration. */
import { COURSE, type Bin } from "./metrics.ts";
import { METHODS, methodOf, type MethodId } from "./methods.ts";
import type { Movement, Place } from "./movement.ts";
import { coloured } from "./path.ts";
import { points, svg, targetShape, text } from "./svg.ts";
import type { Summary, Trace } from "./tally.ts";
import { NOTHING, percent } from "./words.ts";

export interface PictureParts {
  readonly movement: SVGSVGElement;
  readonly course: SVGSVGElement;
  readonly calibration: SVGSVGElement;
  /** What each shows, in words. */
  readonly movementWords: HTMLElement;
  readonly courseWords: HTMLElement;
  readonly calibrationWords: HTMLElement;
}

/** The charts' own units: a square of side 100 with room for the axes' numbers. */
const SIDE = 100;

export class Pictures {
  readonly #parts: PictureParts;

  constructor(parts: PictureParts) {
    this.#parts = parts;
  }

  draw(summary: Summary | null, last: { readonly movement: Movement; readonly trace: Trace } | null, id: MethodId): void {
    if (last) this.#movement(last.movement, last.trace, id);
    if (!summary) {
      this.#clear();
      return;
    }
    this.#course(summary, id);
    this.#calibration(summary.rows.find((row) => row.id === id)?.figures.bins ?? [], id, summary);
  }

  #clear(): void {
    const { movement, course, calibration, movementWords, courseWords, calibrationWords } = this.#parts;
    for (const drawing of [movement, course, calibration]) drawing.replaceChildren();
    for (const words of [movementWords, courseWords, calibrationWords]) words.textContent = NOTHING;
  }

  #movement(movement: Movement, trace: Trace, id: MethodId): void {
    const { movement: drawing, movementWords } = this.#parts;
    const edges = movement.targets.map(([x, y, w, h]) => [x - w / 2, y - h / 2, x + w / 2, y + h / 2] as const);
    const low = ([0, 1] as const).map((axis) => Math.min(...edges.map((edge) => edge[axis]))) as [number, number];
    const high = ([2, 3] as const).map((axis) => Math.max(...edges.map((edge) => edge[axis]))) as [number, number];
    const size = [high[0] - low[0], high[1] - low[1]] as const;
    const room = 0.05 * Math.max(...size);
    drawing.setAttribute("viewBox", [low[0] - room, low[1] - room, size[0] + 2 * room, size[1] + 2 * room].join(" "));
    const round = movement.targets.every(([, , w, h]) => w === h);
    const shapes = movement.targets.map((box, k) => targetShape(box, round, k === movement.target ? "target asked" : "target"));
    const tops = trace.tops[id];
    drawing.replaceChildren(...shapes, coloured(movement, tops ?? [], id === "pointing" ? trace.selected : []));
    const name = methodOf(id).name;
    movementWords.textContent = tops
      ? `${name}: the right target was on top after ${tops.filter((top) => top === movement.target).length} of ${tops.length} samples up to the entry.`
      : `${name} was not recorded with it.`;
  }

  #course({ rows }: Summary, id: MethodId): void {
    const { course: drawing, courseWords } = this.#parts;
    drawing.replaceChildren(...axes("start", "entry"));
    const line = (course: readonly number[], name: string) =>
      svg("polyline", {
        class: name,
        points: points(course.map((right, k): Place => [(SIDE * k) / (COURSE - 1), SIDE - right])),
      });
    const others = METHODS.filter((method) => method.id !== id);
    const courseOf = (wanted: MethodId) => {
      const row = rows.find((each) => each.id === wanted);
      return row && row.figures.movements > 0 ? row.figures.course : null;
    };
    for (const other of others) {
      const course = courseOf(other.id);
      if (course) drawing.append(line(course, "curve"));
    }
    const course = courseOf(id);
    if (course) drawing.append(line(course, "curve shown"));
    const at = (share: number) => percent(course?.[Math.round(share * (COURSE - 1))] ?? null);
    courseWords.textContent = course
      ? `${methodOf(id).name}: right in ${at(0.25)} of the movements after a quarter of the time, ${at(0.5)} after half, ${at(0.75)} after three quarters. Thin: the other methods.`
      : `${methodOf(id).name} has no curve here. Thin: the other methods.`;
  }

  #calibration(bins: readonly Bin[], id: MethodId, summary: Summary): void {
    const { calibration: drawing, calibrationWords } = this.#parts;
    drawing.replaceChildren(...axes("0%", "100%"), svg("line", { class: "diagonal", x1: 0, y1: SIDE, x2: SIDE, y2: 0 }));
    const all = bins.reduce((sum, bin) => sum + bin.count, 0);
    const found = bins.filter((bin) => bin.count > 0);
    const places = found.map((bin): Place => [(SIDE * bin.predicted) / bin.count, SIDE - (SIDE * bin.happened) / bin.count]);
    drawing.append(svg("polyline", { class: "curve shown", points: points(places) }));
    places.forEach(([cx, cy], k) => {
      const r = 1.2 + 5 * Math.sqrt((found[k]?.count ?? 0) / all);
      drawing.append(svg("circle", { class: "bin", cx, cy, r }));
    });
    const error = summary.rows.find((row) => row.id === id)?.figures.calibration ?? null;
    const name = methodOf(id).name;
    calibrationWords.textContent =
      error === null
        ? `${name} names one target and gives no probability.`
        : `${name}: calibration error ${error.toFixed(3)} over ${all.toLocaleString("en")} samples. On the line, 80% comes true 80 times in 100; below it, it is too sure.`;
  }
}

/** Grid, and where the axes begin and stop. */
function axes(from: string, to: string): SVGElement[] {
  const rules = [0, 25, 50, 75, 100].map((y) => svg("line", { class: "rule", x1: 0, y1: y, x2: SIDE, y2: y }));
  return [
    ...rules,
    text("100%", { class: "axis", x: -3, y: 2.5, "text-anchor": "end" }),
    text("50%", { class: "axis", x: -3, y: 52.5, "text-anchor": "end" }),
    text("0%", { class: "axis", x: -3, y: 102.5, "text-anchor": "end" }),
    text(from, { class: "axis", x: 0, y: 112, "text-anchor": "start" }),
    text(to, { class: "axis", x: SIDE, y: 112, "text-anchor": "end" }),
  ];
}
