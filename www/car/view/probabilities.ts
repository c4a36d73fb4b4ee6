/** The right-hand side: the leading five, none of them, the time to go. */
import type { Remaining } from "whither/dom";
import { percent, seconds } from "../../shared/format.ts";
import { ranking } from "../../shared/ranking.ts";

const SHOWN = 5;

interface Row {
  readonly element: HTMLElement;
  readonly name: HTMLElement;
  readonly figure: HTMLElement;
}

/** What is shown: the probabilities of the icons and of none of them, and the time to go. */
export interface Posterior {
  readonly probabilities: Float64Array;
  readonly none: number;
  readonly remaining: Remaining | null;
}

export interface ProbabilityListParts {
  readonly rows: HTMLElement;
  readonly none: HTMLElement;
  readonly remaining: HTMLElement;
  readonly interval: HTMLElement;
  /** What holds all of it, and the words for what it is where it is not of now. */
  readonly root: HTMLElement;
  readonly note: HTMLElement;
}

export class ProbabilityList {
  readonly #labels: readonly string[];
  readonly #parts: ProbabilityListParts;
  /** The rows stay where they are, one for each rank: what moves is their light. */
  readonly #rows: readonly Row[];

  constructor(parts: ProbabilityListParts, labels: readonly string[]) {
    this.#labels = labels;
    this.#parts = parts;
    this.#rows = Array.from({ length: SHOWN }, row);
    parts.rows.append(...this.#rows.map((each) => each.element));
  }

  /** The probability of none of them is another one by now; what is shown stays. */
  move(none: number): void {
    this.#parts.none.style.setProperty("--probability", none.toFixed(6));
  }

  /** Nothing moves: what is shown stays, faint, until the next movement; `null`: as it is called already. */
  rest(note: string | null): void {
    this.move(1);
    if (note !== null) this.#mark(note);
  }

  /** What it shows before the first movement. */
  example(posterior: Posterior, note: string): void {
    this.paint(posterior);
    this.rest(note);
  }

  paint({ probabilities, none, remaining }: Posterior): void {
    this.#mark("");
    const order = ranking(probabilities);
    this.#rows.forEach(({ element, name, figure }, rank) => {
      const index = order[rank] ?? 0;
      const probability = probabilities[index] ?? 0;
      write(name, this.#labels[index] ?? "");
      write(figure, percent(probability));
      element.style.setProperty("--share", probability.toFixed(4));
    });
    this.move(none);
    write(this.#parts.none, percent(none));
    write(this.#parts.remaining, remaining ? seconds(remaining.mean) : "–");
    write(this.#parts.interval, remaining ? `80%: ${remaining.low.toFixed(2)} to ${remaining.high.toFixed(2)} s` : "");
  }

  #mark(note: string): void {
    write(this.#parts.note, note);
    this.#parts.root.toggleAttribute("data-faint", note !== "");
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
