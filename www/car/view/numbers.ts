/** The outcome of the last press, and of all presses together. */
import type { LedgerSummary, Outcome } from "whither/dom";
import type { Press } from "../press.ts";
import { milliseconds, percent } from "./format.ts";
import { sentence } from "./sentences.ts";

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

  /** A simulated movement, before the first real one. */
  example(press: Press): void {
    this.#write(`An example, until you move. ${describe(press)}`);
  }

  /** A movement is under way. */
  movement(simulated: boolean): void {
    this.#write(simulated ? "Simulated hand, under way" : "Under way");
  }

  last(press: Press, simulated: boolean): void {
    this.#write(`${simulated ? "Simulated hand. " : ""}${describe(press)}`);
  }

  /** `learnt` is what the presses have taught about the visitor, if they do. */
  total({ presses, lead, right, wrong }: LedgerSummary, learnt: Outcome["learnt"]): void {
    this.#parts.median.textContent = milliseconds(lead);
    this.#parts.right.textContent = percent(right);
    this.#parts.wrong.textContent = percent(wrong);
    const over = presses === 1 ? "Over 1 press" : `Over ${presses} presses`;
    const times = learnt?.confidence.toFixed(2);
    const taught = learnt ? `. Learnt from them: your movements count ${times} times as much as at first` : "";
    this.#parts.presses.textContent = `${over}${taught}.`;
  }

  #write(text: string): void {
    if (text === this.#under) return;
    this.#under = text;
    this.#parts.lead.textContent = text;
  }
}

function describe(press: Press): string {
  return `${press.label}: ${sentence(press)}`;
}
