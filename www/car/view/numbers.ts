/** The outcome of the last press, and of all presses together. */
import type { Outcome } from "../movement/outcome.ts";
import type { Summary } from "../movement/tally.ts";
import { milliseconds, percent } from "./format.ts";
import { verdict } from "./sentences.ts";

export interface NumbersParts {
  readonly lead: HTMLElement;
  readonly median: HTMLElement;
  readonly right: HTMLElement;
  readonly wrong: HTMLElement;
  readonly presses: HTMLElement;
}

export class Numbers {
  readonly #parts: NumbersParts;
  readonly #labels: readonly string[];
  #under = "";

  constructor(parts: NumbersParts, labels: readonly string[]) {
    this.#parts = parts;
    this.#labels = labels;
  }

  /** A simulated movement, before the first real one. */
  example(outcome: Outcome): void {
    this.#write(`An example, until you move. ${this.#describe(outcome)}`);
  }

  /** A movement is under way. */
  movement(simulated: boolean): void {
    this.#write(simulated ? "Simulated hand, under way" : "Under way");
  }

  last(outcome: Outcome, simulated: boolean): void {
    this.#write(`${simulated ? "Simulated hand. " : ""}${this.#describe(outcome)}`);
  }

  total({ presses, medianLead, right, wrong }: Summary): void {
    this.#parts.median.textContent = milliseconds(medianLead);
    this.#parts.right.textContent = percent(right);
    this.#parts.wrong.textContent = percent(wrong);
    this.#parts.presses.textContent = presses === 1 ? "Over 1 press" : `Over ${presses} presses`;
  }

  #describe(outcome: Outcome): string {
    return `${this.#labels[outcome.chosen] ?? ""}: ${verdict(outcome, this.#labels)}`;
  }

  #write(text: string): void {
    if (text === this.#under) return;
    this.#under = text;
    this.#parts.lead.textContent = text;
  }
}
