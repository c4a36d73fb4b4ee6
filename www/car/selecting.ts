/**
 * Select at the threshold: the page names an icon, and what the ring closes around is selected, with no press. What that saves is counted,
 * and how often it is wrong, which is known because the icon was named.
 */
export interface Selection {
  /** Places in the reading order. */
  readonly wanted: number;
  readonly selected: number;
  /** By hand, before any ring had closed, where it is "press". */
  readonly by: "ring" | "press";
  /**
   * Seconds from the selection until the pointer was on the icon; where the hand stopped before, the time to go that the model expected at
   * the selection. 0 for what was pressed, and for a wrong one.
   */
  readonly saved: number;
  /** Whether it was measured, or expected by the model. */
  readonly measured: boolean;
}

export interface Tally {
  readonly selections: number;
  readonly wrong: number;
  readonly pressed: number;
  /** Seconds, over all selections. */
  readonly saved: number;
  /** How many of the saved times the model expected. */
  readonly expected: number;
}

/** Where one icon is being gone to: open until something is selected, then until it is known what that saved. */
type Trial =
  | { readonly state: "open"; readonly wanted: number }
  | { readonly state: "selected"; readonly wanted: number; readonly time: number; readonly expected: number };

/** One hand that goes to icons that are named. Times are in seconds. */
export class Selecting {
  readonly #done: (selection: Selection) => void;
  #trial: Trial | null = null;
  #over: number | null = null;
  #tally: Tally = { selections: 0, wrong: 0, pressed: 0, saved: 0, expected: 0 };

  /** `done` is called when a selection is complete, what it saved included. */
  constructor(done: (selection: Selection) => void) {
    this.#done = done;
  }

  get tally(): Tally {
    return this.#tally;
  }

  /** The icon to go to, while none is selected. */
  get wanted(): number | null {
    return this.#trial?.state === "open" ? this.#trial.wanted : null;
  }

  /** Whether it is still to be known what a selection saved. */
  get waiting(): boolean {
    return this.#trial?.state === "selected";
  }

  name(wanted: number): void {
    this.#trial = { state: "open", wanted };
  }

  cancel(): void {
    this.#trial = null;
  }

  /** The ring has closed around an icon, `expected` seconds before the pointer is on it. Gives whether that selects it. */
  ringed(selected: number, time: number, expected: number): boolean {
    if (this.#trial?.state !== "open") return false;
    const { wanted } = this.#trial;
    if (selected !== wanted) this.#finish({ wanted, selected, by: "ring", saved: 0, measured: true });
    else if (this.#over === wanted) this.#finish({ wanted, selected, by: "ring", saved: 0, measured: true });
    else this.#trial = { state: "selected", wanted, time, expected };
    return true;
  }

  /** An icon was pressed. */
  pressed(selected: number): void {
    if (this.#trial?.state === "open")
      this.#finish({ wanted: this.#trial.wanted, selected, by: "press", saved: 0, measured: true });
  }

  /** The pointer is over an icon, or over none. */
  over(index: number | null, time: number): void {
    this.#over = index;
    if (this.#trial?.state !== "selected" || index !== this.#trial.wanted) return;
    // the event may be of a moment before the frame in which the ring closed
    this.#save(Math.max(0, time - this.#trial.time), true);
  }

  /** The movement is over. */
  rested(): void {
    if (this.#trial?.state === "selected") this.#save(this.#trial.expected, false);
  }

  #save(saved: number, measured: boolean): void {
    const wanted = this.#trial?.wanted ?? 0;
    this.#finish({ wanted, selected: wanted, by: "ring", saved, measured });
  }

  #finish(selection: Selection): void {
    const { wanted, selected, by, saved, measured } = selection;
    const { selections, wrong, pressed, saved: before, expected } = this.#tally;
    this.#trial = null;
    this.#tally = {
      selections: selections + 1,
      wrong: wrong + Number(selected !== wanted),
      pressed: pressed + Number(by === "press"),
      saved: before + saved,
      expected: expected + Number(!measured),
    };
    this.#done(selection);
  }
}
