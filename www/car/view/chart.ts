/** The last movement: who was how probable when, the press, and how long before it the answer was right. */
import uPlot from "uplot";
import "uplot/dist/uPlot.min.css";
import type { Moment } from "../history.ts";
import type { Press } from "../press.ts";
import { bandsOf, OWN, spotOf, stack, type Band } from "./bands.ts";
import { colours } from "../../shared/colours.ts";
import { seconds } from "../../shared/format.ts";

/** A movement shorter than this does not fill the width (seconds). */
const SHORTEST = 0.6;

/** Of each area its colour and that of its name. */
const BANDS = [
  ["band-1", "on-light"],
  ["band-2", "on-band"],
  ["band-3", "on-light"],
  ["band-4", "on-band"],
  ["band-5", "on-light"],
  ["band-others", "on-band"],
  ["band-none", "text"],
] as const;
const NAMES = [...BANDS.flat(), "muted", "ground", "dim"] as const;
const NO_COLOURS = Object.fromEntries(NAMES.map((name) => [name, ""])) as Record<(typeof NAMES)[number], string>;

export class Chart {
  readonly #root: HTMLElement;
  readonly #labels: readonly string[];
  #plot: uPlot;
  #bands: readonly Band[] = [];
  #press: Press | null = null;
  #start = 0;
  #rem = 0;
  #colours = NO_COLOURS;
  #data: uPlot.AlignedData = [[], ...Array.from({ length: OWN + 2 }, () => [])];

  constructor(root: HTMLElement, labels: readonly string[]) {
    this.#root = root;
    this.#labels = labels;
    this.#plot = this.#make();
    new ResizeObserver(() => {
      if (this.#rem === remOf()) this.#plot.setSize(this.#size());
      else this.restyle();
    }).observe(root);
  }

  /** After a change of theme or of the text's size: colours and sizes are read again. */
  restyle(): void {
    this.#plot.destroy();
    this.#plot = this.#make();
    this.#fitTime();
  }

  /** A movement under way, or with its press a finished one; an example is fainter. */
  draw(moments: readonly Moment[], press: Press | null, example = false): void {
    this.#root.toggleAttribute("data-example", example);
    this.#root.setAttribute("aria-label", described(press));
    this.#start = moments[0]?.time ?? 0;
    this.#press = press;
    this.#bands = bandsOf(moments, this.#labels);
    const times = moments.map((moment) => moment.time - this.#start);
    const columns = this.#bands.map((band) => [...band.values]);
    if (press) {
      times.push(press.time - this.#start);
      for (const column of columns) column.push(column.at(-1) ?? 0);
    }
    this.#data = [times, ...stack(columns)];
    this.#plot.setData(this.#data, false);
    this.#fitTime();
  }

  #fitTime(): void {
    this.#plot.setScale("x", { min: 0, max: Math.max(SHORTEST, this.#data[0].at(-1) ?? 0) });
  }

  #size(): { width: number; height: number } {
    return { width: this.#root.clientWidth, height: this.#root.clientHeight };
  }

  #make(): uPlot {
    const rem = remOf();
    this.#rem = rem;
    this.#colours = colours(this.#root, NAMES);
    const axis: uPlot.Axis = {
      stroke: this.#colours.muted,
      font: `${0.75 * rem}px ${getComputedStyle(this.#root).fontFamily}`,
      grid: { show: false },
      ticks: { show: false },
      gap: 0.35 * rem,
    };
    return new uPlot(
      {
        ...this.#size(),
        padding: [1.75 * rem, rem, 0, 0],
        legend: { show: false },
        cursor: { show: false },
        scales: { x: { time: false }, y: { range: [0, 1] } },
        axes: [
          {
            ...axis,
            size: 1.6 * rem,
            space: 5 * rem,
            values: (_, splits) => splits.map((split) => `${Number(split.toFixed(2))} s`),
          },
          { ...axis, size: 3 * rem, splits: () => [0, 0.5, 1], values: (_, splits) => splits.map((split) => `${split * 100}%`) },
        ],
        series: [{}, ...BANDS.map(([fill]) => area(this.#colours[fill], this.#colours.ground))],
        bands: Array.from({ length: OWN + 1 }, (_, place) => ({ series: [place + 2, place + 1] as [number, number] })),
        hooks: { draw: [(plot) => this.#annotate(plot)] },
      },
      this.#data,
      this.#root,
    );
  }

  #annotate(plot: uPlot): void {
    const { ctx: context } = plot;
    const ratio = devicePixelRatio;
    const size = 0.78 * this.#rem * ratio;
    context.save();
    context.font = `500 ${size}px ${getComputedStyle(this.#root).fontFamily}`;
    context.textAlign = "center";
    context.textBaseline = "middle";
    if (this.#press) this.#showLead(plot, context, this.#press, size);
    this.#nameBands(plot, context, size);
    context.restore();
  }

  /** The lead is lit, what came before it is dimmed; a dimension line above it gives its length. */
  #showLead(plot: uPlot, context: CanvasRenderingContext2D, { time, lead }: Press, size: number): void {
    const { left, top, height } = plot.bbox;
    const pressed = plot.valToPos(time - this.#start, "x", true);
    const since = plot.valToPos(time - lead - this.#start, "x", true);
    context.fillStyle = this.#colours.dim;
    context.fillRect(left, top, since - left, height);
    context.strokeStyle = this.#colours.text;
    context.lineWidth = 2 * devicePixelRatio;
    line(context, pressed, top - 1.6 * size, pressed, top + height);
    if (lead === 0) return;
    const text = seconds(lead);
    const half = context.measureText(text).width / 2 + size / 2;
    const middle = (since + pressed) / 2;
    const level = top - size;
    const fits = pressed - since > 2 * half + size;
    context.lineWidth = devicePixelRatio;
    line(context, since, top - 1.6 * size, since, top + height);
    line(context, since, level, fits ? middle - half : pressed, level);
    if (fits) line(context, middle + half, level, pressed, level);
    context.fillStyle = this.#colours.text;
    context.fillText(text, fits ? middle : since - half, level);
  }

  /** A name is placed where its area has most room, if there is enough, and on none of the lines. */
  #nameBands(plot: uPlot, context: CanvasRenderingContext2D, size: number): void {
    const xs = (this.#data[0] as number[]).map((time) => plot.valToPos(time, "x", true));
    const lines = this.#press ? [this.#press.time, this.#press.time - this.#press.lead] : [];
    const avoid = lines.map((time) => plot.valToPos(time - this.#start, "x", true));
    const nothing = xs.map(() => 0);
    // what was before the icon was lit is dimmed
    const dimmed = avoid[1] ?? 0;
    this.#bands.forEach((band, place) => {
      const half = context.measureText(band.label).width / 2 + size / 2;
      const below = place === 0 ? nothing : (this.#data[place] as number[]);
      const spot = spotOf(xs, below, this.#data[place + 1] as number[], half, avoid);
      if (!spot || spot.room * plot.bbox.height < 1.5 * size) return;
      context.fillStyle = this.#colours[spot.x < dimmed ? "text" : (BANDS[place]?.[1] ?? "text")];
      context.fillText(band.label, spot.x, plot.valToPos(spot.y, "y", true));
    });
  }
}

/** The chart of a press, for who cannot look at it. */
function described(press: Press | null): string {
  if (!press) return "Probabilities over the movement, stacked";
  const lit = press.lead > 0 ? `lit ${seconds(press.lead)} before the press` : "not lit before the press";
  return `Probabilities over the movement, stacked: ${press.label} ${lit}`;
}

/** What a rem is now, in px. */
function remOf(): number {
  return Number.parseFloat(getComputedStyle(document.documentElement).fontSize);
}

function area(fill: string, edge: string): uPlot.Series {
  return { fill, stroke: edge, width: 1.5, points: { show: false } };
}

function line(context: CanvasRenderingContext2D, x1: number, y1: number, x2: number, y2: number): void {
  context.beginPath();
  context.moveTo(x1, y1);
  context.lineTo(x2, y2);
  context.stroke();
}
