/** Plays movements of the simulated hand in the field, as an arrow that anyone can follow. */
import type { Movement, Sample } from "./movement.ts";

export interface PlayerEvents {
  /** Its samples so far in this movement; none when it goes. */
  moved(samples: readonly Sample[]): void;
  /** A movement is over; `rest` are those that follow. */
  arrived(movement: Movement, rest: readonly Movement[]): void;
  /** It plays no more. */
  ended(): void;
}

/** How much faster than it was moved. */
const SPEED = 1.6;

export class Player {
  readonly #events: PlayerEvents;
  #frame = 0;

  constructor(events: PlayerEvents) {
    this.#events = events;
  }

  get playing(): boolean {
    return this.#frame !== 0;
  }

  /** At once where the visitor wants nothing to move. */
  play(movements: readonly Movement[], atOnce: boolean): void {
    this.stop();
    const [movement, ...rest] = movements;
    if (atOnce) movements.forEach((each, k) => this.#events.arrived(each, movements.slice(k + 1)));
    if (!movement || atOnce) {
      this.#events.moved([]);
      this.#events.ended();
      return;
    }
    const { samples } = movement;
    const begin = performance.now();
    let at = 0;
    const step = () => {
      const now = ((performance.now() - begin) / 1000) * SPEED;
      while (at + 1 < samples.length && (samples[at + 1]?.[0] ?? 0) <= now) at += 1;
      this.#events.moved(samples.slice(0, at + 1));
      this.#frame = requestAnimationFrame(step);
      if (at + 1 < samples.length) return;
      this.#events.arrived(movement, rest);
      // where that has not stopped it
      if (!this.#frame) return;
      cancelAnimationFrame(this.#frame);
      this.#frame = 0;
      this.play(rest, false);
    };
    this.#frame = requestAnimationFrame(step);
  }

  stop(): void {
    if (!this.#frame) return;
    cancelAnimationFrame(this.#frame);
    this.#frame = 0;
    this.#events.moved([]);
    this.#events.ended();
  }
}
