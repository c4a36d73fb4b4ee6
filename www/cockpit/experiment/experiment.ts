/** A hundred gestures, method by method: computed in a worker, shown as they come. */
import { Lines } from "../lines.ts";
import type { Road } from "../road.ts";
import { METHODS } from "./methods.ts";
import { type Score, SHARES } from "./score.ts";
import { type Row, summary } from "./summary.ts";
import type { Answer, Order } from "./worker.ts";

const COUNT = 100;
/** The columns of the table that are shares of the time. */
const HALF = SHARES.indexOf(0.5);
const THREE_QUARTERS = SHARES.indexOf(0.75);

export interface ExperimentParts {
  readonly chart: HTMLElement;
  readonly table: HTMLTableSectionElement;
  readonly run: HTMLButtonElement;
  readonly progress: HTMLProgressElement;
  /** In words, for everybody. */
  readonly state: HTMLElement;
  readonly equal: HTMLElement;
}

export class Experiment {
  readonly #parts: ExperimentParts;
  readonly #lines: Lines;
  readonly #road: () => Road;
  #worker: Worker | null = null;
  #scores: (readonly Score[])[] = [];
  #order: Order | null = null;
  #frame = 0;

  /** `road` is asked whenever it begins. */
  constructor(parts: ExperimentParts, road: () => Road) {
    this.#parts = parts;
    this.#road = road;
    const series = METHODS.flatMap(({ line }) => (line ? [line] : []));
    this.#lines = new Lines(parts.chart, { series, x: (share) => `${Math.round(share * 100)}%`, named: 34 });
    parts.table.append(...METHODS.map(row));
    parts.run.addEventListener("click", () => (this.#worker ? this.#stop(false) : this.#start()));
    this.#show();
  }

  restyle(): void {
    this.#lines.restyle();
  }

  /** The first hundred, if nobody has begun yet. */
  startOnce(): void {
    if (!this.#order) this.#start();
  }

  /** The next hundred; the first ones have the seed 1. */
  #start(): void {
    const worker = new Worker(new URL("./worker.ts", import.meta.url), { type: "module" });
    this.#worker = worker;
    this.#scores = [];
    this.#order = { seed: (this.#order?.seed ?? 0) + 1, count: COUNT, road: this.#road() };
    worker.addEventListener("message", ({ data }: MessageEvent<Answer>) => {
      if ("error" in data) return this.#fail(data.error);
      this.#scores.push(data.scores);
      if (this.#scores.length === COUNT) this.#stop(true);
      this.#refresh();
    });
    worker.addEventListener("error", ({ message }) => this.#fail(message || "the worker did not start"));
    worker.postMessage(this.#order);
    this.#refresh();
  }

  #fail(message: string): void {
    this.#stop(false);
    this.#parts.state.textContent = `The gestures could not be computed: ${message}`;
  }

  #stop(complete: boolean): void {
    this.#worker?.terminate();
    this.#worker = null;
    this.#parts.state.dataset["complete"] = String(complete);
    this.#refresh();
  }

  #refresh(): void {
    this.#frame ||= requestAnimationFrame(() => {
      this.#frame = 0;
      this.#show();
    });
  }

  #show(): void {
    const { run, progress, state, table, equal } = this.#parts;
    const done = this.#scores.length;
    run.textContent = this.#worker ? "Cancel" : done > 0 ? "Another 100" : "Simulate 100";
    progress.value = done / COUNT;
    if (this.#order) {
      const { seed, road } = this.#order;
      const how = `seed ${seed}, road ${road.deviation} mm at ${road.frequency} Hz`;
      state.textContent = this.#worker ? `${done} of ${COUNT} gestures, ${how}` : `${done} simulated gestures, ${how}`;
    }
    if (done === 0) return;
    const rows = summary(this.#scores);
    const drawn = rows.filter((_, k) => METHODS[k]?.line);
    this.#lines.draw([[...SHARES], ...drawn.map(({ right }) => [...right])], 1);
    METHODS.forEach(({ id }, k) => fill(table.querySelector(`[data-method="${id}"]`), rows[k] as Row));
    equal.textContent = equality(rows);
  }
}

/** With roles, since a small screen lays it out otherwise than as a table. */
function row({ id, name, line }: (typeof METHODS)[number]): HTMLTableRowElement {
  const element = document.createElement("tr");
  element.setAttribute("role", "row");
  element.dataset["method"] = id;
  const head = document.createElement("th");
  head.scope = "row";
  head.setAttribute("role", "rowheader");
  head.textContent = name;
  if (line) head.dataset["line"] = id;
  const cells = Array.from({ length: 5 }, () => {
    const cell = document.createElement("td");
    cell.setAttribute("role", "cell");
    cell.textContent = "–";
    return cell;
  });
  element.append(head, ...cells);
  return element;
}

function fill(element: Element | null, { right, time, loss, cost }: Row): void {
  const percent = (share = 0) => `${Math.round(100 * share)}%`;
  const microseconds = Math.round(cost * 1e6);
  const texts = [
    percent(time),
    percent(right[HALF]),
    percent(right[THREE_QUARTERS]),
    ...(loss === null ? ["–", "–"] : [loss.toFixed(2), `${microseconds} µs`]),
  ];
  element?.querySelectorAll("td").forEach((cell, k) => {
    if (cell.textContent !== texts[k]) cell.textContent = texts[k] ?? "";
  });
}

/** What the equal methods differ by. */
function equality(rows: readonly Row[]): string {
  const of = (id: string) => rows[METHODS.findIndex((method) => method.id === id)]?.difference ?? 0;
  const liang = Math.max(of("algorithm1"), of("algorithm2"));
  return `Largest difference of any probability: ${scientific(liang)} between algorithm 1, algorithm 2 and the pseudo-observation, ${scientific(of("singleFilter"))} between bridging and the single filter.`;
}

function scientific(value: number): string {
  if (value === 0) return "0";
  const [mantissa = "", exponent = ""] = value.toExponential(0).split("e");
  const raised = exponent.replace(/\d|-|\+/g, (sign) =>
    sign === "-" ? "⁻" : sign === "+" ? "" : ("⁰¹²³⁴⁵⁶⁷⁸⁹"[Number(sign)] ?? ""),
  );
  return `${mantissa}·10${raised}`;
}
