/** The posterior over a movement: the 21 icons, the one that is touched in light, and the same by the other model. */
import { LABELS, TARGETS } from "./cabin.ts";
import type { Moment } from "./forecast.ts";
import { type Drawing, Lines, type Series, stroke } from "./lines.ts";

export interface Course {
  readonly moments: readonly Moment[];
  /** By the model that is not chosen; of the same samples. */
  readonly others: readonly Moment[];
  /** The index of the icon that is touched, or leads. */
  readonly icon: number;
  readonly touched: boolean;
  /** Where in `moments` it is now. */
  readonly at: number;
  readonly shake: boolean;
}

/** The shortest time axis, and how far it reaches beyond a movement that is under way; in seconds. */
const SHORTEST = 0.8;
const AHEAD = 0.8;
/** The icon's line is named where it first is as high as this, the other model's where both differ most, and by so much. */
const CLEAR = 0.4;
const APART = 0.08;

export class PosteriorChart {
  readonly #lines: Lines;
  #course: Course | null = null;

  constructor(root: HTMLElement) {
    const quiet: Series = { ink: "rest", width: 1, alpha: 0.55 };
    this.#lines = new Lines(root, {
      series: [...TARGETS.map(() => quiet), { ink: "text", width: 1.5, dash: [4, 4] }, { ink: "light", width: 3 }],
      x: (value) => `${Number(value.toFixed(2))} s`,
      more: (drawing) => this.#annotate(drawing),
    });
  }

  restyle(): void {
    this.#lines.restyle();
  }

  draw(course: Course): void {
    this.#course = course;
    const { moments, others, icon } = course;
    const times = moments.map((moment) => moment.sample[0] - this.#start);
    const of = (list: readonly Moment[], index: number) => list.map(({ probabilities }) => probabilities[index] ?? 0);
    const last = Math.max(SHORTEST, (times.at(-1) ?? 0) + (course.touched ? 0 : AHEAD));
    this.#lines.draw([times, ...TARGETS.map((_, index) => of(moments, index)), of(others, icon), of(moments, icon)], last);
  }

  get #start(): number {
    return this.#course?.moments[0]?.sample[0] ?? 0;
  }

  /** When it is expected to touch, in seconds on the axis. */
  #expected(): { now: number; low: number; mean: number; high: number } {
    const moment = this.#course?.moments[this.#course.at];
    const now = (moment?.sample[0] ?? 0) - this.#start;
    const { low = 0, mean = 0, high = 0 } = moment?.remaining ?? {};
    return { now, low: now + low, mean: now + mean, high: now + high };
  }

  /** Now, the touch, when it is expected, and the names of both lines. */
  #annotate(drawing: Drawing): void {
    const { context, plot, ink, size, ratio } = drawing;
    const course = this.#course;
    if (!course || course.moments.length < 2) return;
    const { left, top, width, height } = plot.bbox;
    const x = (seconds: number) => Math.min(left + width, plot.valToPos(seconds, "x", true));
    const { now, low, mean, high } = this.#expected();
    const above = top - 0.75 * size;
    context.lineWidth = 1.5 * ratio;
    context.strokeStyle = ink.text;
    stroke(context, [x(now), top], [x(now), top + height]);
    if (course.touched) {
      const touch = x((course.moments.at(-1)?.sample[0] ?? 0) - this.#start);
      context.setLineDash([2 * ratio, 3 * ratio]);
      stroke(context, [touch, top], [touch, top + height]);
      context.setLineDash([]);
    }
    const isOver = course.touched && course.at >= course.moments.length - 1;
    if (high > now && !isOver) {
      context.strokeStyle = context.fillStyle = ink.light;
      context.lineWidth = 2 * ratio;
      stroke(context, [x(low), above], [x(high), above]);
      context.beginPath();
      context.arc(x(mean), above, 4 * ratio, 0, 2 * Math.PI);
      context.fill();
    }
    context.fillStyle = ink.text;
    const of = (list: readonly Moment[], k: number) => list[k]?.probabilities[course.icon] ?? 0;
    const clear = course.moments.findIndex((_, k) => of(course.moments, k) >= CLEAR);
    if (clear >= 0) this.#label(drawing, course.moments[clear], LABELS[course.icon] ?? "", -1);
    const apart = course.moments.map((_, k) => Math.abs(of(course.moments, k) - of(course.others, k)));
    const most = apart.indexOf(Math.max(...apart));
    if ((apart[most] ?? 0) >= APART) this.#label(drawing, course.others[most], course.shake ? "without shake" : "with shake", 1);
  }

  /** A name beside its line: left of it, or right. */
  #label({ context, plot, size }: Drawing, moment: Moment | undefined, text: string, side: 1 | -1): void {
    if (!moment || !this.#course) return;
    const x = plot.valToPos(moment.sample[0] - this.#start, "x", true);
    const y = plot.valToPos(moment.probabilities[this.#course.icon] ?? 0, "y", true);
    const { left, top, width, height } = plot.bbox;
    const wide = context.measureText(text).width;
    context.textAlign = side < 0 ? "right" : "left";
    const inside = side < 0 ? Math.max(left + wide + 2, x - 0.6 * size) : Math.min(left + width - wide - 2, x + 0.6 * size);
    context.fillText(text, inside, Math.min(top + height - size, Math.max(top + size, y)));
  }
}
