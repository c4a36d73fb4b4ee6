/** The methods side by side: the best first, by the column that was chosen. */
import type { Figures } from "./metrics.ts";
import { METHODS, methodOf, type MethodId } from "./methods.ts";
import type { Scored } from "./score.worker.ts";
import { strip } from "./strip.ts";
import type { Row, Summary } from "./tally.ts";
import { milliseconds, nats, NOTHING, percent, reasonFor } from "./words.ts";

type Column = "time" | "lead" | "right" | "wrong" | "loss" | "calibration";

/** The columns in their order, whether less is better, and what a narrow screen calls them. */
const COLUMNS: Readonly<
  Record<Column, { readonly less: boolean; readonly label: string; readonly text: (figures: Figures) => string }>
> = {
  time: { less: false, label: "Right", text: ({ time }) => percent(time) },
  lead: { less: false, label: "Lead", text: ({ lead }) => milliseconds(lead) },
  right: { less: false, label: "Selected right", text: ({ right }) => percent(right) },
  wrong: { less: true, label: "Selected wrong", text: ({ wrong }) => percent(wrong) },
  loss: { less: true, label: "Log loss", text: ({ loss }) => nats(loss) },
  calibration: { less: true, label: "Calibration", text: ({ calibration }) => nats(calibration) },
};

export class Table {
  readonly #table: HTMLTableElement;
  readonly #chosen: (id: MethodId) => void;
  #column: Column = "time";
  #summary: Summary | null = null;
  #last: Scored["last"] = null;
  #isOwn = false;
  #shown: MethodId = "pointing";

  /** `chosen` is called with the method whose pictures are asked for. */
  constructor(table: HTMLTableElement, chosen: (id: MethodId) => void) {
    this.#table = table;
    this.#chosen = chosen;
    for (const head of table.querySelectorAll<HTMLElement>("th[data-column]")) {
      head.querySelector("button")?.addEventListener("click", () => {
        this.#column = head.dataset["column"] as Column;
        this.#draw();
      });
    }
    table.tBodies[0]?.replaceChildren(...METHODS.map(({ id }) => this.#row(id)));
  }

  get shown(): MethodId {
    return this.#shown;
  }

  show(summary: Summary | null, last: Scored["last"], isOwn: boolean): void {
    this.#summary = summary;
    this.#last = last;
    this.#isOwn = isOwn;
    this.#draw();
  }

  /** The row of a method: its name is a button that shows its pictures. */
  #row(id: MethodId): HTMLTableRowElement {
    const { name, what } = methodOf(id);
    const row = document.createElement("tr");
    row.role = "row";
    row.dataset["method"] = id;
    const head = document.createElement("th");
    head.scope = "row";
    head.role = "rowheader";
    const button = document.createElement("button");
    button.type = "button";
    button.className = "method";
    button.textContent = name;
    button.addEventListener("click", () => {
      this.#shown = id;
      this.#draw();
      this.#chosen(id);
    });
    const note = document.createElement("span");
    note.className = "note";
    note.textContent = what;
    head.append(button, note);
    row.append(
      head,
      ...Object.entries(COLUMNS).map(([column, { label }]) => cellOf(column, label)),
      cellOf("last", "The last movement"),
    );
    return row;
  }

  #draw(): void {
    const rows = this.#summary?.rows ?? [];
    const movements = this.#summary?.movements ?? 0;
    for (const head of this.#table.querySelectorAll<HTMLElement>("th[data-column]")) {
      const column = head.dataset["column"] as Column;
      if (column === this.#column) head.setAttribute("aria-sort", COLUMNS[column].less ? "ascending" : "descending");
      else head.removeAttribute("aria-sort");
    }
    const body = this.#table.tBodies[0];
    if (!body) return;
    const elements = new Map([...body.rows].map((row) => [row.dataset["method"], row]));
    const order = [...rows].sort((a, b) => this.#value(b, movements) - this.#value(a, movements));
    for (const [place, row] of order.entries()) {
      const element = elements.get(row.id);
      if (!element) continue;
      this.#fill(element, row, movements);
      element.toggleAttribute("data-leads", place === 0 && movements > 0);
      // a row that is where it belongs keeps the focus
      if (body.rows[place] !== element) body.insertBefore(element, body.rows[place] ?? null);
    }
    for (const [id, element] of elements) {
      element.querySelector("button")?.setAttribute("aria-pressed", String(id === this.#shown));
    }
  }

  #fill(element: HTMLTableRowElement, row: Row, movements: number): void {
    const any = row.figures.movements > 0;
    for (const [column, { text }] of Object.entries(COLUMNS)) {
      const cell = element.querySelector<HTMLElement>(`[data-of=${column}]`);
      if (cell) cell.textContent = any ? text(row.figures) : NOTHING;
    }
    const time = element.querySelector<HTMLElement>("[data-of=time]");
    if (time && any) {
      const spread = document.createElement("span");
      spread.className = "spread";
      spread.textContent = row.spread === null ? "" : `±${row.spread.toFixed(0)}`;
      time.append(spread);
    }
    const tops = this.#last?.trace.tops[row.id];
    element.querySelector("[data-of=last]")?.replaceChildren(this.#last && tops ? strip(this.#last.movement, tops) : NOTHING);
    const note = element.querySelector(".note");
    const { samples, ahead } = this.#summary?.best ?? { samples: 0, ahead: 0 };
    const grid = `${samples} samples, ${1000 * ahead} ms: the best of 24 on these very movements`;
    const what = row.id === "extrapolation" && any ? grid : methodOf(row.id).what;
    if (note) note.textContent = (movements > 0 && reasonFor(row, movements, this.#isOwn)) || what;
  }

  /** By which rows are ordered: those that were not scored on all movements come last, those without a number after the others. */
  #value({ figures }: Row, movements: number): number {
    const { less } = COLUMNS[this.#column];
    const value = figures[this.#column];
    if (value === null || figures.movements === 0) return -Infinity;
    return (less ? -value : value) - (figures.movements < movements ? 1e6 : 0);
  }
}

/** A narrow screen shows rows as blocks, which would be no table without roles. */
function cellOf(column: string, label: string): HTMLTableCellElement {
  const cell = document.createElement("td");
  cell.role = "cell";
  cell.dataset["of"] = column;
  cell.dataset["label"] = label;
  cell.textContent = NOTHING;
  return cell;
}
