/** What the pointing model predicts while a pointer is still moving. */
import { init, PointerPredictor } from "whither/pointing";
import type { Box, Sample } from "./movement.ts";

export class Live {
  readonly #predictor = new PointerPredictor([]);
  /** Of the movement that is followed: when it began, and how many of its samples were observed. */
  #start = Number.NaN;
  #count = 0;

  static async begin(): Promise<Live> {
    await init();
    return new Live();
  }

  setTargets(targets: readonly Box[]): void {
    this.#predictor.setTargets(targets.map(([x, y, width, height], id) => ({ id: String(id), x, y, width, height })));
  }

  /** The probabilities of the targets after a movement so far, of which each call has all samples. */
  follow(samples: readonly Sample[]): Float64Array {
    const start = samples[0]?.[0] ?? Number.NaN;
    if (start !== this.#start || samples.length < this.#count) {
      this.#predictor.reset();
      this.#start = start;
      this.#count = 0;
    }
    for (const [time, x, y] of samples.slice(this.#count)) this.#predictor.observe(time, [x, y]);
    this.#count = samples.length;
    return this.#predictor.probabilities();
  }
}
