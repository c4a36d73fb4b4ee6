/** The right-hand side: the leading five, none of them, the time to go. */
import type { Belief } from "../belief/predictions.ts";
import { percent, seconds } from "./format.ts";
import { ranking } from "./order.ts";

const SHOWN = 5;

interface Row {
  readonly element: HTMLElement;
  readonly name: HTMLElement;
  readonly figure: HTMLElement;
}

export interface BelieverParts {
  readonly rows: HTMLElement;
  readonly none: HTMLElement;
  readonly remaining: HTMLElement;
  readonly interval: HTMLElement;
}

export class ProbabilityList {
  readonly #labels: readonly string[];
  readonly #parts: BelieverParts;
  /** The rows stay where they are, one for each rank: what moves is their light. */
  readonly #rows: readonly Row[];
  #order: number[];

  constructor(parts: BelieverParts, labels: readonly string[]) {
    this.#labels = labels;
    this.#parts = parts;
    this.#rows = Array.from({ length: SHOWN }, row);
    this.#order = labels.map((_, index) => index);
    parts.rows.append(...this.#rows.map((each) => each.element));
  }

  /** The most probable ones, in the order of the rows. */
  leading(count: number): number[] {
    return this.#order.slice(0, count);
  }

  paint({ probabilities, none, timeToGo }: Belief): void {
    this.#order = ranking(probabilities);
    this.#rows.forEach(({ element, name, figure }, rank) => {
      const index = this.#order[rank] ?? 0;
      const probability = probabilities[index] ?? 0;
      write(name, this.#labels[index] ?? "");
      write(figure, percent(probability));
      element.style.setProperty("--share", probability.toFixed(4));
    });
    this.#parts.none.style.setProperty("--probability", none.toFixed(6));
    write(this.#parts.none, percent(none));
    write(this.#parts.remaining, timeToGo ? seconds(timeToGo.mean) : "–");
    write(this.#parts.interval, timeToGo ? `80%: ${timeToGo.low.toFixed(2)} to ${timeToGo.high.toFixed(2)} s` : "");
  }
}

/** Does not touch the document when nothing changes. */
function write(element: HTMLElement, text: string): void {
  if (element.textContent !== text) element.textContent = text;
}

function row(): Row {
  const element = document.createElement("li");
  element.className = "row";
  const name = document.createElement("span");
  name.className = "row-name";
  const figure = document.createElement("span");
  figure.className = "row-figure figure";
  const bar = document.createElement("span");
  bar.className = "row-bar";
  element.append(name, figure, bar);
  return { element, name, figure };
}
