/** Fits the pointing model to a session's movements, and states what that gains; nothing is taken for better than it is. */
import type { FitReport, FitResult } from "./fit.worker.ts";
import { LEAST_MOVEMENTS, MOVEMENTS_FOR_ALL, PATHS, pathsFor } from "./folds.ts";
import { approachOf, type Movement } from "./movement.ts";
import { count, NOTHING, signed } from "./words.ts";

export interface FittingParts {
  readonly fit: HTMLButtonElement;
  readonly cancel: HTMLButtonElement;
  readonly progress: HTMLProgressElement;
  /** The result in words. */
  readonly verdict: HTMLElement;
  readonly constants: HTMLElement;
  readonly code: HTMLElement;
  readonly copy: HTMLButtonElement;
}

export class Fitting {
  readonly #parts: FittingParts;
  readonly #announce: (text: string) => void;
  #shown: readonly Movement[] | null = null;
  /** Those that enter their target. */
  #movements: readonly Movement[] = [];
  #worker: Worker | null = null;
  #hasResult = false;

  constructor(parts: FittingParts, announce: (text: string) => void) {
    this.#parts = parts;
    this.#announce = announce;
    parts.fit.addEventListener("click", () => this.#start());
    parts.cancel.addEventListener("click", () => {
      this.#stop();
      this.#write("Cancelled: nothing was learnt.");
    });
    parts.copy.addEventListener("click", () => void this.#copy());
    this.#list(null);
  }

  /** What can be learnt from. What was learnt before from fewer stays, with their number. */
  show(movements: readonly Movement[]): void {
    if (movements === this.#shown) return;
    this.#shown = movements;
    this.#movements = movements.filter((movement) => approachOf(movement) !== null);
    const { length } = this.#movements;
    this.#parts.fit.disabled = this.#worker !== null || pathsFor(length) === null;
    if (this.#worker || this.#hasResult) return;
    this.#parts.verdict.textContent = this.#before(length);
  }

  /** Another session is shown next: what was learnt is not its. */
  clear(): void {
    this.#stop();
    this.#list(null);
    this.#shown = null;
  }

  #before(movements: number): string {
    const paths = pathsFor(movements);
    if (!paths) return `${count(LEAST_MOVEMENTS - movements, "more movement")} to go: it takes at least ${LEAST_MOVEMENTS}.`;
    const all = `all five from ${MOVEMENTS_FOR_ALL} on`;
    return `${count(movements, "movement")}: enough for ${paths.length} constants${movements < MOVEMENTS_FOR_ALL ? `, ${all}` : ""}.`;
  }

  #start(): void {
    const paths = pathsFor(this.#movements.length);
    if (!paths) return;
    const { progress, cancel } = this.#parts;
    const worker = new Worker(new URL("./fit.worker.ts", import.meta.url), { type: "module" });
    this.#worker = worker;
    this.#list(null);
    progress.value = 0;
    progress.hidden = false;
    cancel.hidden = false;
    cancel.focus();
    this.#parts.fit.disabled = true;
    this.#write(`Learning ${paths.length} constants from ${count(this.#movements.length, "movement")}…`);
    worker.addEventListener("message", ({ data }: MessageEvent<FitReport>) => {
      if (data.kind === "progress") {
        progress.value = data.share;
        return;
      }
      this.#stop();
      if (data.kind === "error") this.#write(`It cannot be fitted: ${data.message}`);
      else this.#show(data.result);
    });
    worker.addEventListener("error", ({ message }) => {
      this.#stop();
      this.#write(`It cannot be fitted: ${message || "the worker does not load"}`);
    });
    worker.postMessage({ movements: this.#movements, paths });
  }

  #stop(): void {
    if (!this.#worker) return;
    this.#worker.terminate();
    this.#worker = null;
    this.#parts.progress.hidden = true;
    const focused = document.activeElement === this.#parts.cancel;
    this.#parts.cancel.hidden = true;
    this.#parts.fit.disabled = pathsFor(this.#movements.length) === null;
    if (focused) this.#parts.fit.focus();
  }

  #show(result: FitResult): void {
    this.#list(result);
    this.#write(verdict(result));
  }

  /** All constants that can be learnt, those that were with their values. */
  #list(result: FitResult | null): void {
    const { constants, code, copy } = this.#parts;
    this.#hasResult = result !== null;
    const learnt = (path: string) => result?.constants.find((constant) => constant.path === path);
    constants.replaceChildren(...PATHS.map((path) => entry(path, learnt(path))));
    code.textContent = JSON.stringify(result?.sections ?? {}, null, 2);
    copy.textContent = "Copy the constants";
    copy.disabled = result === null;
  }

  #write(text: string): void {
    this.#parts.verdict.textContent = text;
    this.#announce(text);
  }

  async #copy(): Promise<void> {
    const { code, copy } = this.#parts;
    try {
      await navigator.clipboard.writeText(code.textContent ?? "");
      copy.textContent = "Copied";
    } catch {
      const details = code.closest("details");
      if (details) details.open = true;
      getSelection()?.selectAllChildren(code);
      copy.textContent = "Selected: copy it with the keyboard";
    }
    this.#announce(copy.textContent);
  }
}

/** What was gained, over movements that were left out. */
export function verdict({ movements, before, after, gain }: FitResult): string {
  const [low, high] = [gain.mean - gain.half, gain.mean + gain.half].map((bound) => signed(bound, 3));
  const figures =
    `log loss ${before.loss.toFixed(3)} nats as shipped, ${after.loss.toFixed(3)} fitted; ` +
    `right ${before.time.toFixed(1)}% of the time, then ${after.time.toFixed(1)}%`;
  const how = `Over ${count(movements, "movement")}, each third scored with what was learnt from the other two: ${figures}.`;
  if (gain.mean - gain.half > 0) return `A gain of ${gain.mean.toFixed(3)} nats (95% interval ${low} to ${high}). ${how}`;
  const less = gain.mean > 0 ? `${gain.mean.toFixed(3)} nats are within chance` : "on movements left out it is no better";
  return `No gain: ${less} (95% interval ${low} to ${high}). Keep the constants as shipped. ${how}`;
}

function entry(path: string, learnt: FitResult["constants"][number] | undefined): HTMLElement {
  const row = document.createElement("div");
  const name = document.createElement("dt");
  const value = document.createElement("dd");
  row.className = "fact";
  value.className = "figure";
  name.textContent = path;
  const digits = (number: number) => String(Number(number.toPrecision(3)));
  value.textContent = learnt ? `${digits(learnt.before)} → ${digits(learnt.after)}` : NOTHING;
  row.append(name, value);
  return row;
}
