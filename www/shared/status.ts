/** The state in status: the visible sentence at once, and for screen readers seldom enough to be followed. */

/** Milliseconds between two announcements. */
const PAUSE = 700;

export class Status {
  readonly #visible: HTMLElement;
  readonly #live: HTMLElement;
  #text = "";
  #last = -Infinity;
  #timer: ReturnType<typeof setTimeout> | null = null;

  /** A visible element, and a live region for screen readers. */
  constructor(visible: HTMLElement, live: HTMLElement) {
    this.#visible = visible;
    this.#live = live;
  }

  /** Shown, not announced. */
  show(text: string): void {
    if (this.#visible.textContent !== text) this.#visible.textContent = text;
  }

  /** Shown at once and announced: of several texts the last one wins, and `now` does not wait. */
  write(text: string, now = false): void {
    this.show(text);
    this.announce(text, now);
  }

  /** Announced, not shown. */
  announce(text: string, now = false): void {
    if (text === this.#text) return;
    this.#text = text;
    if (this.#timer !== null) {
      if (!now) return;
      clearTimeout(this.#timer);
      this.#timer = null;
    }
    const wait = now ? 0 : this.#last + PAUSE - performance.now();
    if (wait <= 0) this.#flush();
    else this.#timer = setTimeout(() => this.#flush(), wait);
  }

  #flush(): void {
    this.#timer = null;
    this.#last = performance.now();
    this.#live.textContent = this.#text;
  }
}
