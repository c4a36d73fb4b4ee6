/** The mode in which the threshold selects: names icons to go to, the ghost's too, reports what was selected, and counts it. */
import type { Remaining } from "whither/dom";
import { random } from "whither/testing";
import { ObservedEvent, SHAKEN } from "./shaken.ts";
import { Selecting, type Selection } from "./selecting.ts";
import type { Screen } from "./view/screen.ts";
import { errand, selecting, selection, tally } from "./view/sentences.ts";

/** Milliseconds for which what was selected is reported before the next icon is named. */
const PAUSE = 1600;

/** An icon that is named is at least so many widths away. */
const FAR = 2.5;

export interface ErrandsParts {
  readonly screen: Screen;
  readonly tally: HTMLElement;
}

export class Errands {
  readonly #labels: readonly string[];
  readonly #parts: ErrandsParts;
  /** Called when the sentence has changed and nothing else has. */
  readonly #changed: () => void;
  readonly #visitor: Selecting;
  readonly #ghost: Selecting;
  readonly #next = random(7);
  #active = false;
  #simulated = false;
  #report: string | null = null;
  #selected = 0;
  #timer: ReturnType<typeof setTimeout> | null = null;
  /** Where the visitor's pointer was last, as an icon. */
  #last = 0;

  constructor(labels: readonly string[], parts: ErrandsParts, changed: () => void) {
    this.#labels = labels;
    this.#parts = parts;
    this.#changed = changed;
    this.#visitor = new Selecting((done) => this.#done(done, false));
    this.#ghost = new Selecting((done) => this.#done(done, true));
    addEventListener("pointermove", (event) => this.#over(event), { passive: true });
  }

  get active(): boolean {
    return this.#active;
  }

  /** The sentence of it now; null where there is none. */
  get sentence(): string | null {
    if (!this.#active) return null;
    if (this.#report !== null) return this.#report;
    const { wanted, waiting } = this.#hand;
    if (waiting) return selecting(this.#labelOf(this.#selected));
    return wanted === null ? null : errand(this.#labelOf(wanted));
  }

  activate(active: boolean): void {
    this.#active = active;
    this.#turn();
    if (active) this.#count();
  }

  /** The ghost has come, or gone. */
  enter(simulated: boolean): void {
    this.#simulated = simulated;
    this.#turn();
    if (this.#active) this.#count();
  }

  /** The ghost sets out for an icon. */
  heads(index: number): void {
    if (this.#active) this.#name(this.#ghost, index);
  }

  /** The ring has closed around an icon. */
  ringed(icon: HTMLButtonElement, remaining: Remaining | null): void {
    const index = this.#parts.screen.icons.indexOf(icon);
    if (!this.#active) return;
    this.#selected = index;
    if (!this.#hand.ringed(index, performance.now() / 1000, remaining?.mean ?? 0)) return;
    this.#parts.screen.acknowledge(index);
    this.#parts.screen.want(null);
  }

  /** The visitor has pressed an icon. */
  pressed(index: number): void {
    if (this.#active) this.#visitor.pressed(index);
  }

  /** The movement is over. */
  rested(): void {
    if (this.#active) this.#hand.rested();
  }

  get #hand(): Selecting {
    return this.#simulated ? this.#ghost : this.#visitor;
  }

  #labelOf(index: number): string {
    return this.#labels[index] ?? "";
  }

  /** Whoever's turn it is begins anew. */
  #turn(): void {
    if (this.#timer !== null) clearTimeout(this.#timer);
    this.#timer = null;
    this.#report = null;
    this.#visitor.cancel();
    this.#ghost.cancel();
    this.#parts.screen.want(null);
    if (this.#active && !this.#simulated) this.#name(this.#visitor, this.#choose());
  }

  #name(hand: Selecting, index: number): void {
    this.#report = null;
    hand.name(index);
    this.#parts.screen.want(index);
  }

  /** An icon that is far from where the pointer is. */
  #choose(): number {
    const boxes = this.#parts.screen.measure();
    const from = boxes[this.#last];
    const far = boxes.flatMap((box, index) => {
      const away = from ? Math.hypot((box.x - from.x) / from.width, (box.y - from.y) / from.height) : 0;
      return away > FAR ? [index] : [];
    });
    return far[Math.floor(this.#next() * far.length)] ?? 0;
  }

  #done(done: Selection, simulated: boolean): void {
    this.#report = selection(done, this.#labelOf(done.selected), this.#labelOf(done.wanted));
    this.#parts.screen.want(null);
    this.#count();
    this.#changed();
    if (simulated) return;
    this.#timer = setTimeout(() => {
      this.#name(this.#visitor, this.#choose());
      this.#changed();
    }, PAUSE);
  }

  #count(): void {
    const counted = this.#hand.tally;
    const whose = this.#simulated ? "The simulated hand: " : "You: ";
    this.#parts.tally.textContent = `${whose}${counted.selections === 0 ? "no selection yet." : tally(counted)}`;
  }

  /** Events of every pointer go to what they are over, those of a finger on the glass apart. It is on an icon within its ring. */
  #over(event: PointerEvent): void {
    const simulated = event instanceof ObservedEvent && event.pointerType !== SHAKEN;
    if (simulated !== this.#simulated) return;
    const at = event.pointerType === "touch" ? document.elementFromPoint(event.clientX, event.clientY) : event.target;
    const lamp = at instanceof Element ? at.closest(".lamp") : null;
    const index = this.#parts.screen.icons.findIndex((icon) => lamp !== null && icon.contains(lamp));
    if (!simulated && index >= 0) this.#last = index;
    if (this.#active) this.#hand.over(index < 0 ? null : index, event.timeStamp / 1000);
  }
}
