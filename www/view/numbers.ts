/** What the last press says, and all presses together. */
import type { Outcome } from "../movement/history.ts";
import type { Summary } from "../movement/tally.ts";
import { milliseconds, percent } from "./format.ts";

export interface NumbersParts {
  readonly lead: HTMLElement;
  readonly median: HTMLElement;
  readonly right: HTMLElement;
  readonly wrong: HTMLElement;
  readonly presses: HTMLElement;
}

export class Numbers {
  readonly #parts: NumbersParts;
  #under = "";

  constructor(parts: NumbersParts) {
    this.#parts = parts;
  }

  /** A movement is under way. */
  movement(simulated: boolean): void {
    this.#say(simulated ? "Simulated hand, under way" : "Under way");
  }

  last(outcome: Outcome, label: string, simulated: boolean): void {
    this.#say(`${simulated ? "Simulated hand. " : ""}${label}: ${sentence(outcome)}`);
  }

  total({ presses, medianLead, earlyRight, earlyWrong }: Summary): void {
    this.#parts.median.textContent = milliseconds(medianLead);
    this.#parts.right.textContent = percent(earlyRight);
    this.#parts.wrong.textContent = percent(earlyWrong);
    this.#parts.presses.textContent = presses === 1 ? "Over 1 press" : `Over ${presses} presses`;
  }

  #say(text: string): void {
    if (text === this.#under) return;
    this.#under = text;
    this.#parts.lead.textContent = text;
  }
}

export function sentence({ rightSince, lead }: Outcome): string {
  return rightSince === null ? "not on top before the press" : `right ${milliseconds(lead)} before the press`;
}
