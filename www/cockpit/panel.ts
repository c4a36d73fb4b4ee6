/** The right-hand side: the leading five, none of them, the time to go. */
import { LABELS } from "./cabin.ts";
import type { Moment } from "./forecast.ts";
import { percent, seconds } from "../shared/format.ts";
import { ranking } from "../shared/ranking.ts";

const SHOWN = 5;

export interface PanelParts {
  readonly rows: HTMLElement;
  readonly none: HTMLElement;
  readonly remaining: HTMLElement;
  readonly interval: HTMLElement;
}

export class Panel {
  readonly #parts: PanelParts;
  /** One for each rank. */
  readonly #rows: readonly { readonly element: HTMLElement; readonly name: HTMLElement; readonly figure: HTMLElement }[];

  constructor(parts: PanelParts) {
    this.#parts = parts;
    this.#rows = Array.from({ length: SHOWN }, row);
    parts.rows.append(...this.#rows.map(({ element }) => element));
  }

  /** Once the hand touches there is no time to go. */
  show(moment: Moment | null, touched: boolean): void {
    const { rows, none, remaining, interval } = this.#parts;
    const probabilities = moment?.probabilities ?? new Float64Array(LABELS.length).fill(1 / LABELS.length);
    const order = ranking(probabilities);
    rows.dataset["leader"] = moment ? (LABELS[order[0] ?? 0] ?? "") : "";
    this.#rows.forEach(({ element, name, figure }, rank) => {
      const icon = order[rank] ?? 0;
      const probability = probabilities[icon] ?? 0;
      write(name, LABELS[icon] ?? "");
      write(figure, percent(probability));
      element.style.setProperty("--share", probability.toFixed(4));
    });
    const left = touched ? null : moment?.remaining;
    write(none, moment ? percent(moment.none) : "–");
    write(remaining, touched ? "there" : left ? seconds(left.mean) : "–");
    write(interval, left ? `80%: ${left.low.toFixed(2)} to ${left.high.toFixed(2)} s` : "");
  }
}

/** Does not touch the document when nothing changes. */
function write(element: HTMLElement, text: string): void {
  if (element.textContent !== text) element.textContent = text;
}

function row() {
  const element = document.createElement("li");
  element.className = "row";
  const part = (className: string) => {
    const span = document.createElement("span");
    span.className = className;
    return span;
  };
  const [name, figure, bar] = [part("row-name"), part("row-figure figure"), part("row-bar")];
  element.append(name, figure, bar);
  return { element, name, figure };
}
