/** The right-hand side: whose movements are shown, and how well the pointing model predicted them. */
import type { Session, SessionName } from "./sessions.ts";
import { milliseconds, nats, NOTHING, percent } from "./words.ts";

export interface PanelParts {
  /** Its `[data-fact]` are filled. */
  readonly facts: HTMLElement;
  readonly own: HTMLInputElement;
  readonly simulated: HTMLInputElement;
  readonly ownCount: HTMLElement;
  readonly simulatedCount: HTMLElement;
  readonly progress: HTMLProgressElement;
}

export class Panel {
  readonly #parts: PanelParts;

  /** `chosen` is called where the visitor changes the session. */
  constructor(parts: PanelParts, chosen: (name: SessionName) => void) {
    this.#parts = parts;
    for (const name of ["own", "simulated"] as const) parts[name].addEventListener("change", () => chosen(name));
  }

  /** How many movements a session has. Where the visitor has none, there are none to show. */
  count(name: SessionName, movements: number): void {
    this.#parts[`${name}Count`].textContent = String(movements);
    if (name === "own") this.#parts.own.disabled = movements === 0;
  }

  show(name: SessionName, { movements: { length }, summary, waiting }: Session): void {
    const { own, simulated, progress } = this.#parts;
    (name === "own" ? own : simulated).checked = true;
    progress.value = length > 0 ? 1 - waiting / length : 1;
    progress.classList.toggle("idle", waiting === 0);
    const figures = summary?.rows.find(({ id }) => id === "pointing")?.figures;
    const done = summary?.movements ?? 0;
    const any = figures && done > 0 ? figures : null;
    this.#fact("movements", waiting > 0 ? `${done}, ${waiting} to go` : String(done));
    this.#fact("time", percent(any?.time ?? null));
    this.#fact("lead", any ? milliseconds(any.lead) : NOTHING);
    this.#fact("right", percent(any?.right ?? null));
    this.#fact("wrong", percent(any?.wrong ?? null));
    this.#fact("calibration", nats(any?.calibration ?? null));
    this.#fact("loss", any ? `${nats(any.loss)} nats` : NOTHING);
  }

  /** What is predicted now, of which target `asked` is the right one; nothing without probabilities. */
  now(probabilities: ArrayLike<number> | null, asked: number): void {
    if (!probabilities) {
      this.#fact("now", NOTHING);
      return;
    }
    const top = Array.from(probabilities).reduce((best, p, k, all) => (p > (all[best] ?? 0) ? k : best), 0);
    this.#fact("now", `${percent(100 * (probabilities[top] ?? 0))}, ${top === asked ? "the right one" : "another one"}`);
  }

  #fact(name: string, words: string): void {
    const element = this.#parts.facts.querySelector(`[data-fact=${name}]`);
    if (element && element.textContent !== words) element.textContent = words;
  }
}
