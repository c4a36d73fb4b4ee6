/** What the last press says, and all presses together. */
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

  /** A movement that nobody made yet. */
  example(outcome: Outcome): void {
    this.#write(`An example, until you move. ${this.#told(outcome)}`);
  }

  /** A movement is under way. */
  movement(simulated: boolean): void {
    this.#write(simulated ? "Simulated hand, under way" : "Under way");
  }

  last(outcome: Outcome, simulated: boolean): void {
    this.#write(`${simulated ? "Simulated hand. " : ""}${this.#told(outcome)}`);
  }

  total({ presses, medianLead, right, wrong }: Summary): void {
    this.#parts.median.textContent = milliseconds(medianLead);
    this.#parts.right.textContent = percent(right);
    this.#parts.wrong.textContent = percent(wrong);
    this.#parts.presses.textContent = presses === 1 ? "Over 1 press" : `Over ${presses} presses`;
  }

  #told(outcome: Outcome): string {
    return `${this.#labels[outcome.chosen] ?? ""}: ${verdict(outcome, this.#labels)}`;
  }

  #write(text: string): void {
    if (text === this.#under) return;
    this.#under = text;
    this.#parts.lead.textContent = text;
  }
}
