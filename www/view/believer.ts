/** The right-hand side: the leading five, none of them, the time to go. */
import type { Belief } from "../belief/predictions.ts";
import type { Place } from "../destinations.ts";
import { percent, seconds } from "./format.ts";
import { reorder } from "./order.ts";

const SHOWN = 5;

interface Row {
  readonly element: HTMLElement;
  readonly figure: HTMLElement;
}

export interface BelieverParts {
  readonly rows: HTMLElement;
  readonly none: HTMLElement;
  readonly remaining: HTMLElement;
  readonly interval: HTMLElement;
}

export class Believer {
  readonly #rows: readonly Row[];
  readonly #parts: BelieverParts;
  #order: number[];

  constructor(parts: BelieverParts, places: readonly Place[]) {
    this.#parts = parts;
    this.#rows = places.map((place) => row(place.label));
    this.#order = places.map((_, index) => index);
    parts.rows.append(...this.#rows.map((each) => each.element));
  }

  /** The most probable ones, in the order of the rows. */
  leading(count: number): number[] {
    return this.#order.slice(0, count);
  }

  paint({ probabilities, none, timeToGo }: Belief): void {
    this.#order = reorder(this.#order, probabilities);
    this.#order.forEach((index, rank) => {
      const each = this.#rows[index];
      if (!each) return;
      const probability = probabilities[index] ?? 0;
      each.element.style.setProperty("--rank", String(Math.min(rank, SHOWN)));
      each.element.style.setProperty("--probability", probability.toFixed(4));
      each.element.toggleAttribute("data-shown", rank < SHOWN);
      each.element.toggleAttribute("data-strip", rank < 3);
      if (rank < SHOWN) write(each.figure, percent(probability));
    });
    this.#parts.none.style.setProperty("--probability", none.toFixed(6));
    write(this.#parts.none, percent(none));
    write(this.#parts.remaining, timeToGo ? seconds(timeToGo.mean) : "–");
    write(this.#parts.interval, timeToGo ? `80%: ${timeToGo.low.toFixed(2)} to ${timeToGo.high.toFixed(2)} s` : "");
  }
}

/** Leaves the document alone when nothing changes. */
function write(element: HTMLElement, text: string): void {
  if (element.textContent !== text) element.textContent = text;
}

function row(label: string): Row {
  const element = document.createElement("li");
  element.className = "row";
  const name = document.createElement("span");
  name.className = "row-name";
  name.textContent = label;
  const figure = document.createElement("span");
  figure.className = "row-figure figure";
  const bar = document.createElement("span");
  bar.className = "row-bar";
  element.append(name, figure, bar);
  return { element, figure };
}
