/** A chart of lines that are named on it, by uPlot. */
import uPlot from "uplot";
import "uplot/dist/uPlot.min.css";
import { colours } from "../shared/colours.ts";
import { spread } from "./spread.ts";

const INK = ["light", "text", "muted", "rest", "line"] as const;
type Ink = (typeof INK)[number];

export interface Series {
  /** On the chart, right of its end; none is named by a text beside it. */
  readonly name?: string;
  readonly ink: Ink;
  /** In px at the text's usual size. */
  readonly width: number;
  /** From 0 to 1. @defaultValue 1 */
  readonly alpha?: number;
  /** Mark and gap, in px. */
  readonly dash?: readonly number[];
}

/** What it is drawn with, in px of the canvas. */
export interface Drawing {
  readonly context: CanvasRenderingContext2D;
  readonly plot: uPlot;
  readonly ink: Readonly<Record<Ink, string>>;
  /** The size of the text. */
  readonly size: number;
  readonly ratio: number;
}

export interface LinesOptions {
  readonly series: readonly Series[];
  /** A place on the x axis in words. */
  x(value: number): string;
  /** The chart's width in rem from which on its lines are named. @defaultValue they never are */
  readonly named?: number;
  /** Draws more over it. */
  more?(drawing: Drawing): void;
}

/** Room for names, in rem. */
const NAMES = 11.5;

export class Lines {
  readonly #root: HTMLElement;
  readonly #options: LinesOptions;
  #plot: uPlot;
  #ink: Record<Ink, string>;
  #rem: number;
  #data: uPlot.AlignedData;
  #last = 1;

  constructor(root: HTMLElement, options: LinesOptions) {
    this.#root = root;
    this.#options = options;
    this.#data = [[], ...options.series.map(() => [])];
    this.#ink = colours(root, INK);
    this.#rem = remOf();
    this.#plot = this.#make();
    new ResizeObserver(() => this.restyle()).observe(root);
  }

  /** After a change of theme or of the text's size: colours and sizes are read again. */
  restyle(): void {
    this.#plot.destroy();
    this.#ink = colours(this.#root, INK);
    this.#rem = remOf();
    this.#plot = this.#make();
    this.draw(this.#data, this.#last);
  }

  /** The x axis goes from 0 to `last`; each series has a number for each x, from 0 to 1. */
  draw(data: uPlot.AlignedData, last: number): void {
    this.#data = data;
    this.#last = last;
    this.#plot.batch(() => {
      this.#plot.setData(data, false);
      this.#plot.setScale("x", { min: 0, max: last });
    });
  }

  #make(): uPlot {
    const rem = this.#rem;
    const { clientWidth: width, clientHeight: height } = this.#root;
    const named = width >= (this.#options.named ?? Number.POSITIVE_INFINITY) * rem;
    const axis: uPlot.Axis = {
      stroke: this.#ink.muted,
      font: `${0.75 * rem}px ${getComputedStyle(this.#root).fontFamily}`,
      ticks: { show: false },
      grid: { stroke: this.#ink.line, width: 1 },
      gap: 0.35 * rem,
    };
    return new uPlot(
      {
        width,
        height,
        padding: [1.5 * rem, (named ? NAMES : 1.25) * rem, 0, 0],
        legend: { show: false },
        cursor: { show: false },
        scales: { x: { time: false }, y: { range: [0, 1] } },
        axes: [
          { ...axis, size: 1.75 * rem, space: 4.5 * rem, values: (_, splits) => splits.map((split) => this.#options.x(split)) },
          {
            ...axis,
            size: 3 * rem,
            splits: () => [0, 0.25, 0.5, 0.75, 1],
            values: (_, splits) => splits.map((split) => (split % 0.5 === 0 ? `${split * 100}%` : "")),
          },
        ],
        series: [
          {},
          ...this.#options.series.map(
            ({ ink, width, alpha = 1, dash }): uPlot.Series => ({
              stroke: this.#ink[ink],
              width: (width * rem) / 16,
              alpha,
              points: { show: false },
              ...(dash ? { dash: dash.map((part) => (part * rem) / 16) } : {}),
            }),
          ),
        ],
        hooks: { draw: [(plot) => this.#annotate(plot, named)] },
      },
      this.#data,
      this.#root,
    );
  }

  #annotate(plot: uPlot, named: boolean): void {
    const ratio = devicePixelRatio;
    const size = 0.78 * this.#rem * ratio;
    const { ctx: context } = plot;
    context.save();
    context.font = `500 ${size}px ${getComputedStyle(this.#root).fontFamily}`;
    context.textBaseline = "middle";
    const drawing: Drawing = { context, plot, ink: this.#ink, size, ratio };
    if (named) this.#name(drawing);
    this.#options.more?.(drawing);
    context.restore();
  }

  /** Names, from top to bottom in the order of the lines' ends, as far apart as they have to be; each with a hairline to its end. */
  #name({ context, plot, ink, size, ratio }: Drawing): void {
    const ends = this.#options.series.flatMap(({ name, ...series }, k) => {
      const column = this.#data[k + 1] as readonly (number | null)[] | undefined;
      const at = column?.findLastIndex((value) => value !== null) ?? -1;
      if (name === undefined || at < 0) return [];
      return [{ name, series, x: this.#data[0][at] ?? 0, value: column?.[at] ?? 0 }];
    });
    ends.sort((a, b) => b.value - a.value);
    const { left, top, width, height } = plot.bbox;
    const gap = 1.3 * size;
    const heights = spread(
      ends.map(({ value }) => plot.valToPos(value, "y", true)),
      gap,
      top,
      top + height,
    );
    const start = left + width;
    context.textAlign = "left";
    ends.forEach(({ name, series, x, value }, k) => {
      const y = heights[k] ?? 0;
      const sample = start + 1.1 * size;
      context.strokeStyle = ink.line;
      context.lineWidth = ratio;
      stroke(context, [plot.valToPos(x, "x", true), plot.valToPos(value, "y", true)], [sample, y]);
      context.strokeStyle = ink[series.ink];
      context.lineWidth = series.width * ratio;
      context.setLineDash((series.dash ?? []).map((part) => part * ratio));
      stroke(context, [sample, y], [sample + 1.6 * size, y]);
      context.setLineDash([]);
      context.fillStyle = ink.text;
      context.fillText(name, sample + 2.1 * size, y);
    });
  }
}

export function stroke(context: CanvasRenderingContext2D, ...points: readonly (readonly [number, number])[]): void {
  context.beginPath();
  for (const [x, y] of points) context.lineTo(x, y);
  context.stroke();
}

/** What a rem is now, in px. */
function remOf(): number {
  return Number.parseFloat(getComputedStyle(document.documentElement).fontSize);
}
