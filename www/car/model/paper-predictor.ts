/** `Predictor` of `whither` in the form that `whither/dom` takes: any method of the papers for a page's elements. */
import { Predictor as Papers, type Scenario } from "whither";
import type { PredictedTarget, Predictor } from "whither/dom";

export class PaperPredictor implements Predictor {
  readonly #scenarioOf: (targets: readonly PredictedTarget[]) => Scenario;
  readonly #accumulates: boolean;
  #targets: readonly PredictedTarget[] = [];
  /** Null without any target. */
  #papers: Papers | null = null;
  /** The time of the last observation, in seconds. */
  #last = 0;

  /** A method that accumulates evidence for each target begins again where one has moved. */
  constructor(
    scenarioOf: (targets: readonly PredictedTarget[]) => Scenario,
    targets: readonly PredictedTarget[],
    accumulates: boolean,
  ) {
    this.#scenarioOf = scenarioOf;
    this.#accumulates = accumulates;
    this.setTargets(targets);
  }

  observe(time: number, position: readonly [number, number]): void {
    this.#last = time;
    this.#papers?.observe(time, position);
  }

  probabilities(into?: Float64Array): Float64Array {
    return this.#papers?.probabilities(into) ?? into ?? new Float64Array(0);
  }

  get none(): number {
    return this.#papers?.none ?? 1;
  }

  /** The mean and the 10 and 90% points of the arrival's nodes. */
  get remaining(): Predictor["remaining"] {
    const arrival = this.#papers?.arrival();
    if (!arrival) return null;
    const later = (time: number) => Math.max(0, time - this.#last);
    const quantile = (share: number) => {
      let sum = 0;
      const node = arrival.probabilities.findIndex((probability) => (sum += probability) >= share);
      return later(arrival.times[node] ?? arrival.mean);
    };
    return { mean: later(arrival.mean), low: quantile(0.1), high: quantile(0.9) };
  }

  forecast(time: number): ReturnType<Predictor["forecast"]> {
    return this.#papers?.forecast(time) ?? null;
  }

  path(id: string, times: readonly number[]): Float64Array {
    return this.#papers?.path(id, times) ?? new Float64Array(0);
  }

  setTargets(targets: readonly PredictedTarget[]): void {
    if (targets.length === this.#targets.length && targets.every((target, i) => isSame(target, this.#targets[i]))) return;
    this.#targets = targets;
    if (targets.length === 0) this.free();
    else if (!this.#papers) this.#papers = new Papers(this.#scenarioOf(targets));
    else {
      if (this.#accumulates) this.#papers.reset();
      this.#papers.setDestinations(this.#scenarioOf(targets).destinations);
    }
  }

  reset(): void {
    this.#papers?.reset();
  }

  free(): void {
    this.#papers?.free();
    this.#papers = null;
  }
}

function isSame(one: PredictedTarget, other: PredictedTarget | undefined): boolean {
  const keys = ["id", "x", "y", "width", "height", "prior"] as const;
  return keys.every((key) => one[key] === other?.[key]);
}
