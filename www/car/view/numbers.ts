/** Whose movement the chart shows, and the outcomes of all presses together. */
import type { LedgerSummary, Outcome } from "whither/dom";
import { percent, seconds } from "../../shared/format.ts";

export interface NumbersParts {
  readonly caption: HTMLElement;
  readonly median: HTMLElement;
  readonly right: HTMLElement;
  readonly wrong: HTMLElement;
  readonly presses: HTMLElement;
}

export class Numbers {
  readonly #parts: NumbersParts;

  constructor(parts: NumbersParts) {
    this.#parts = parts;
  }

  /** A simulated movement, before the first real one. */
  example(): void {
    this.#caption("An example, until you move");
  }

  /** A movement is under way. */
  movement(simulated: boolean): void {
    this.#caption(simulated ? "A simulated hand, under way" : "Under way");
  }

  last(label: string, simulated: boolean): void {
    this.#caption(simulated ? `A simulated hand, to ${label}` : `Yours, to ${label}`);
  }

  /** `learnt` is what the presses have taught about the visitor, if they do. */
  total({ presses, lead, right, wrong }: LedgerSummary, learnt: Outcome["learnt"]): void {
    this.#parts.median.textContent = seconds(lead);
    this.#parts.right.textContent = percent(right);
    this.#parts.wrong.textContent = percent(wrong);
    const over = presses === 1 ? "Over 1 press" : `Over ${presses} presses`;
    const times = learnt?.confidence.toFixed(2);
    const taught = learnt ? `. Learnt from them: your movements count ${times} times as much as at first` : "";
    this.#parts.presses.textContent = `${over}${taught}.`;
  }

  #caption(text: string): void {
    const { caption } = this.#parts;
    if (caption.textContent !== text) caption.textContent = text;
  }
}
