/** The last movement: who was how probable when, the press, and how long before it the answer was right. */
import uPlot from "uplot";
import "uplot/dist/uPlot.min.css";
import type { Moment, Outcome } from "../movement/history.ts";
import { bandsOf, OWN, stack, type Band } from "./bands.ts";
import { milliseconds } from "./format.ts";

/** A movement shorter than this does not fill the width (seconds). */
const SHORTEST = 0.6;

export class Chart {
  readonly #root: HTMLElement;
  readonly #labels: readonly string[];
  #plot: uPlot;
  #bands: readonly Band[] = [];
  #outcome: Outcome | null = null;
  #start = 0;
  #data: uPlot.AlignedData = [[], ...Array.from({ length: OWN + 1 }, () => [])];

  constructor(root: HTMLElement, labels: readonly string[]) {
    this.#root = root;
    this.#labels = labels;
    this.#plot = this.#make();
    new ResizeObserver(() => this.#plot.setSize(this.#size())).observe(root);
  }

  /** After a change of theme: the colours are read again. */
  restyle(): void {
    this.#plot.destroy();
    this.#plot = this.#make();
    this.#fitTime();
  }

  /** A movement under way, or with its outcome a finished one. */
  draw(moments: readonly Moment[], outcome: Outcome | null): void {
    this.#start = moments[0]?.time ?? 0;
    this.#outcome = outcome;
    this.#bands = bandsOf(moments, this.#labels, outcome?.chosen ?? moments.at(-1)?.leader ?? 0);
    const times = moments.map((moment) => moment.time - this.#start);
    const columns = this.#bands.map((band) => [...band.values]);
    if (outcome) {
      times.push(outcome.pressed - this.#start);
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
    const style = getComputedStyle(this.#root);
    const colour = (name: string) => style.getPropertyValue(name).trim();
    const rem = Number.parseFloat(getComputedStyle(document.documentElement).fontSize);
    const axis: uPlot.Axis = {
      stroke: colour("--muted"),
      font: `${0.75 * rem}px ${style.fontFamily}`,
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
          { ...axis, size: 1.6 * rem, space: 5 * rem, values: (_, splits) => splits.map((split) => `${Number(split.toFixed(2))} s`) },
          { ...axis, size: 3 * rem, splits: () => [0, 0.5, 1], values: (_, splits) => splits.map((split) => `${split * 100}%`) },
        ],
        series: [{}, ...this.#data.slice(1).map((_, place) => area(colour(`--band-${place + 1}`), colour("--ground")))],
        bands: Array.from({ length: OWN }, (_, place) => ({ series: [place + 2, place + 1] as [number, number] })),
        hooks: { draw: [(plot) => this.#annotate(plot, colour, rem)] },
      },
      this.#data,
      this.#root,
    );
  }

  #annotate(plot: uPlot, colour: (name: string) => string, rem: number): void {
    const { ctx: context } = plot;
    const ratio = devicePixelRatio;
    const size = 0.78 * rem * ratio;
    context.save();
    context.font = `500 ${size}px ${getComputedStyle(this.#root).fontFamily}`;
    context.textAlign = "center";
    context.textBaseline = "middle";
    const outcome = this.#outcome;
    if (outcome) this.#showLead(plot, context, outcome, colour, size);
    this.#nameBands(plot, context, size, colour);
    context.restore();
  }

  /** The lead is lit, what came before it is dimmed; a dimension line over it says how long it is. */
  #showLead(plot: uPlot, context: CanvasRenderingContext2D, outcome: Outcome, colour: (name: string) => string, size: number): void {
    const { left, top, height } = plot.bbox;
    const pressed = plot.valToPos(outcome.pressed - this.#start, "x", true);
    const since = outcome.rightSince === null ? pressed : plot.valToPos(outcome.rightSince - this.#start, "x", true);
    context.fillStyle = colour("--dim");
    context.fillRect(left, top, since - left, height);
    context.strokeStyle = colour("--text");
    context.lineWidth = 2 * devicePixelRatio;
    line(context, pressed, top - 1.6 * size, pressed, top + height);
    if (outcome.rightSince === null) return;
    const text = milliseconds(outcome.lead);
    const half = context.measureText(text).width / 2 + size / 2;
    const middle = (since + pressed) / 2;
    const level = top - size;
    const fits = pressed - since > 2 * half + size;
    context.lineWidth = devicePixelRatio;
    line(context, since, top - 1.6 * size, since, top + height);
    line(context, since, level, fits ? middle - half : pressed, level);
    if (fits) line(context, middle + half, level, pressed, level);
    context.fillStyle = colour("--text");
    context.fillText(text, fits ? middle : since - half, level);
  }

  /** A name stands where its area has its weight, if there is room. */
  #nameBands(plot: uPlot, context: CanvasRenderingContext2D, size: number, colour: (name: string) => string): void {
    const times = this.#data[0] as number[];
    const { left } = plot.bbox;
    this.#bands.forEach((band, place) => {
      const at = heaviest(times, band.values);
      const upper = (this.#data[place + 1] as number[])[at] ?? 0;
      const lower = place === 0 ? 0 : ((this.#data[place] as number[])[at] ?? 0);
      const room = plot.valToPos(lower, "y", true) - plot.valToPos(upper, "y", true);
      if (room < 1.5 * size) return;
      const half = context.measureText(band.label).width / 2 + size / 2;
      const right = plot.valToPos(times.at(-1) ?? 0, "x", true);
      if (right - left < 2 * half) return;
      const x = Math.min(right - half, Math.max(left + half, plot.valToPos(times[at] ?? 0, "x", true)));
      context.fillStyle = colour(place === 0 ? "--on-light" : "--on-band");
      context.fillText(band.label, x, plot.valToPos((upper + lower) / 2, "y", true));
    });
  }
}

/** The sample nearest to the middle of an area's weight. */
function heaviest(times: readonly number[], values: readonly number[]): number {
  let sum = 0;
  let moment = 0;
  values.forEach((value, index) => {
    sum += value ** 2;
    moment += value ** 2 * (times[index] ?? 0);
  });
  const middle = moment / sum;
  return values.reduce((best, _, index) => (Math.abs((times[index] ?? 0) - middle) < Math.abs((times[best] ?? 0) - middle) ? index : best), 0);
}

function area(fill: string, edge: string): uPlot.Series {
  return { fill, stroke: edge, width: 1, points: { show: false } };
}

function line(context: CanvasRenderingContext2D, x1: number, y1: number, x2: number, y2: number): void {
  context.beginPath();
  context.moveTo(x1, y1);
  context.lineTo(x2, y2);
  context.stroke();
}
