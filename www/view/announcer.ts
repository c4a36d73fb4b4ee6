/** Says in words what is predicted, seldom enough for a screen reader to follow. */

/** Milliseconds between two announcements. */
const PAUSE = 700;

export class Announcer {
  readonly #element: HTMLElement;
  #text = "";
  #last = -Infinity;
  #timer: ReturnType<typeof setTimeout> | null = null;

  constructor(element: HTMLElement) {
    this.#element = element;
  }

  /** The last of several texts wins; `now` says it without waiting. */
  say(text: string, now = false): void {
    if (text === this.#text) return;
    this.#text = text;
    if (this.#timer !== null) {
      if (!now) return;
      clearTimeout(this.#timer);
      this.#timer = null;
    }
    const wait = now ? 0 : this.#last + PAUSE - performance.now();
    if (wait <= 0) this.#speak();
    else this.#timer = setTimeout(() => this.#speak(), wait);
  }

  #speak(): void {
    this.#timer = null;
    this.#last = performance.now();
    this.#element.textContent = this.#text;
  }
}
