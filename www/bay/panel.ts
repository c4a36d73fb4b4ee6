/** The right-hand side: the leading harbours, none of them, the arrival, and what no harbour explains. */
import { part } from "../shared/page.ts";
import type { Anomaly } from "./anomaly.ts";
import { timeOfDay } from "./clock.ts";
import { HARBOURS } from "./coast.ts";
import type { Arriving, Moment } from "./lookout.ts";
import { paper, type Paper } from "./paper.ts";
import { drawArrival } from "./strip.ts";
import { anomaly, between, percent } from "./words.ts";

/** Harbours in the list; "none of them" is under them. */
const LEADING = 4;
/** Anomalies in the list: the latest ones. */
const LISTED = 3;

interface Row {
  readonly element: HTMLElement;
  readonly name: HTMLElement;
  readonly figure: HTMLElement;
}

export class Panel {
  readonly #rows: readonly Row[];
  readonly #anomalies: readonly HTMLElement[];
  #strip: Paper | null = null;

  constructor() {
    this.#rows = Array.from({ length: LEADING + 1 }, (_, rank) => row(part("rows"), rank === LEADING));
    this.#anomalies = Array.from({ length: LISTED }, () => {
      const item = document.createElement("li");
      part("anomalies").append(item);
      return item;
    });
  }

  /** After a change of size or theme. */
  fit(): void {
    this.#strip = paper(part<HTMLCanvasElement>("arrival-strip"));
  }

  show(moment: Moment, now: number, arriving: Arriving | null, anomalies: readonly Anomaly[]): void {
    const { probabilities, none } = moment;
    const order = [...probabilities.keys()].sort((i, j) => (probabilities[j] ?? 0) - (probabilities[i] ?? 0));
    for (const [rank, { element, name, figure }] of this.#rows.entries()) {
      const index = order[rank] ?? 0;
      const last = rank === LEADING;
      const probability = last ? none : (probabilities[index] ?? 0);
      write(name, last ? "None of them" : (HARBOURS[index]?.name ?? ""));
      write(figure, percent(probability));
      element.style.setProperty("--share", probability.toFixed(4));
    }
    write(part("arrival-harbour"), heading(moment, arriving));
    write(part("arrival-time"), arriving ? timeOfDay(arriving.median) : "–");
    write(part("arrival-interval"), arriving ? `80% ${between(arriving)}` : "");
    if (this.#strip) drawArrival(this.#strip, now, arriving);
    const latest = anomalies.slice(-LISTED);
    for (const [index, item] of this.#anomalies.entries()) {
      const found = latest[index];
      const number = anomalies.length - latest.length + index + 1;
      write(item, found ? `${number}. ${timeOfDay(found.time)} ${anomaly(found)}` : index === 0 ? "None so far." : "");
      item.classList.toggle("found", Boolean(found));
    }
  }
}

/** Of the arrival. */
function heading({ best, probabilities }: Moment, arriving: Arriving | null): string {
  if (!arriving) return "Arrival";
  const name = HARBOURS[best]?.name ?? "";
  return (probabilities[best] ?? 0) >= 0.5 ? `At ${name}` : `If it goes to ${name}`;
}

function row(list: HTMLElement, none: boolean): Row {
  const element = document.createElement("li");
  element.className = none ? "row none" : "row";
  const [name, figure, bar] = ["row-name", "row-figure figure", "row-bar"].map((className) => {
    const span = document.createElement("span");
    span.className = className;
    return span;
  }) as [HTMLElement, HTMLElement, HTMLElement];
  bar.setAttribute("aria-hidden", "true");
  element.append(name, figure, bar);
  list.append(element);
  return { element, name, figure };
}

function write(element: HTMLElement, text: string): void {
  if (element.textContent !== text) element.textContent = text;
}
