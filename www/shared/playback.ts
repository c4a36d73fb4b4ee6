/** A button that plays and pauses, and a slider that is where it is. */

export interface PlaybackParts {
  readonly play: HTMLButtonElement;
  readonly slider: HTMLInputElement;
}

export interface PlaybackOptions {
  /** The last place; the first is 0. */
  readonly last: number;
  /** Milliseconds from one place to the next. */
  readonly pace: number;
  /** A place in words, for screen readers. */
  text(place: number): string;
  /** After every change: of the place, and where it plays, pauses or is over. */
  moved(): void;
}

export class Playback {
  readonly #parts: PlaybackParts;
  readonly #options: PlaybackOptions;
  #place: number;
  #last: number;
  #pace: number;
  /** Where and when it began to play; null while it does not. */
  #from: { readonly place: number; readonly time: number } | null = null;
  #frame = 0;

  constructor(parts: PlaybackParts, options: PlaybackOptions, place = 0) {
    this.#parts = parts;
    this.#options = options;
    this.#place = place;
    this.#last = options.last;
    this.#pace = options.pace;
    parts.slider.min = "0";
    parts.play.addEventListener("click", () => (this.playing ? this.pause() : this.play()));
    parts.slider.addEventListener("input", () => this.set(Number(parts.slider.value)));
    this.#show();
  }

  get place(): number {
    return this.#place;
  }

  get playing(): boolean {
    return this.#from !== null;
  }

  /** From where it is; from the beginning where it is at its end. */
  play(): void {
    if (this.#place >= this.#last) this.#place = 0;
    this.#from = { place: this.#place, time: performance.now() };
    this.#frame = requestAnimationFrame(this.#step);
    this.#changed();
  }

  pause(): void {
    this.#stop();
    this.#changed();
  }

  /** From now on the last place is another one, or the pace; it stays where it is, or goes on playing from there. */
  change({ last = this.#last, pace = this.#pace }: { readonly last?: number; readonly pace?: number }): void {
    this.#last = last;
    this.#pace = pace;
    this.#place = Math.min(last, this.#place);
    if (this.#from) this.#from = { place: this.#place, time: performance.now() };
    this.#show();
  }

  /** Goes to a place and stays there. */
  set(place: number): void {
    this.#stop();
    this.#place = Math.min(this.#last, Math.max(0, place));
    this.#changed();
  }

  readonly #step = () => {
    if (!this.#from) return;
    const { place, time } = this.#from;
    const now = Math.min(this.#last, place + Math.floor((performance.now() - time) / this.#pace));
    if (now === this.#last) this.#stop();
    else this.#frame = requestAnimationFrame(this.#step);
    if (now === this.#place) return;
    this.#place = now;
    this.#changed();
  };

  #stop(): void {
    cancelAnimationFrame(this.#frame);
    this.#from = null;
  }

  #changed(): void {
    this.#show();
    this.#options.moved();
  }

  #show(): void {
    const { play, slider } = this.#parts;
    play.textContent = this.playing ? "Pause" : "Play";
    slider.max = String(this.#last);
    slider.value = String(this.#place);
    slider.setAttribute("aria-valuetext", this.#options.text(this.#place));
  }
}
