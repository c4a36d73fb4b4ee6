/** Time saved against wrong selections, for each recorded set: a curve over the thresholds with a point at the one that holds now, and a table. */
import { THRESHOLDS } from "../model/settings.ts";
import { RECORDED, SOURCE, type RecordedSet, type Row } from "../evidence.ts";
import { percent, seconds } from "../../shared/format.ts";

const SVG = "http://www.w3.org/2000/svg";

/** The drawing's size and margins, in units of its own, and what its axes reach to: percent wrong, and milliseconds. */
const SIZE = { width: 420, height: 236, left: 44, right: 16, top: 28, bottom: 40 };
const MOST = { wrong: 50, lead: 800 };

export interface TradeoffParts {
  readonly drawing: SVGSVGElement;
  readonly rows: HTMLElement;
  readonly sentence: HTMLElement;
  /** When the figures were printed, and by what. */
  readonly date: HTMLElement;
  readonly command: HTMLElement;
}

export class Tradeoff {
  readonly #sentence: HTMLElement;
  readonly #sets: readonly { readonly set: RecordedSet; readonly point: SVGElement; readonly cells: readonly HTMLElement[] }[];

  constructor({ drawing, rows, sentence, date, command }: TradeoffParts) {
    this.#sentence = sentence;
    date.textContent = SOURCE.date;
    command.textContent = SOURCE.command;
    drawing.setAttribute("viewBox", `0 0 ${SIZE.width} ${SIZE.height}`);
    drawing.append(...axes());
    this.#sets = RECORDED.map((set, index) => {
      const mark = String(index + 1);
      const first = set.rows[0];
      const curve = shape("polyline", { class: "curve", points: set.rows.map((row) => place(row).join()).join(" ") });
      const [x, y] = first ? place(first) : [0, 0];
      const name = shape("text", { class: "curve-name", x: x + 8, y: y + 4 }, mark);
      const point = shape("circle", { class: "curve-point", r: 6 });
      drawing.append(curve, name, point);
      const { row, cells } = rowOf(set, mark);
      rows.append(row);
      return { set, point, cells };
    });
  }

  /** Marks what the recorded hands had at a threshold. */
  show(threshold: number): void {
    const at = this.#sets.flatMap(({ set, point, cells }) => {
      const row = set.rows.find((each) => each.threshold === threshold);
      if (!row) return [];
      const [x, y] = place(row);
      point.setAttribute("cx", String(x));
      point.setAttribute("cy", String(y));
      const texts = [percent(row.right / 100), percent(row.wrong / 100), seconds(row.lead / 1000)];
      cells.forEach((cell, index) => {
        cell.textContent = texts[index] ?? "";
        cell.style.setProperty("--share", String([row.right, row.wrong][index] ?? 0));
      });
      return [row];
    });
    const movements = RECORDED.reduce((sum, set) => sum + set.movements, 0);
    const right = span(at, (row) => percent(row.right / 100));
    const wrong = span(at, (row) => percent(row.wrong / 100));
    const lead = span(at, (row) => seconds(row.lead / 1000));
    this.#sentence.textContent =
      `At ${percent(threshold)}, of ${movements} recorded movements the first icon to pass was the one pressed in ${right}, ` +
      `${lead} before the press, and another one in ${wrong}.`;
  }
}

/** The threshold of a position of the slider, and back. */
export function thresholdAt(position: number): number {
  return THRESHOLDS[position] ?? THRESHOLDS[0];
}

export function positionOf(threshold: number): number {
  return (THRESHOLDS as readonly number[]).indexOf(threshold);
}

/** From the least to the most of what the sets have, as written. */
function span(rows: readonly Row[], write: (row: Row) => string): string {
  const texts = rows.map(write).sort((one, other) => Number.parseFloat(one) - Number.parseFloat(other));
  return `${texts[0]} to ${texts.at(-1)}`;
}

function place({ wrong, lead }: Row): readonly [x: number, y: number] {
  const { width, height, left, right, top, bottom } = SIZE;
  return [left + (wrong / MOST.wrong) * (width - left - right), height - bottom - (lead / MOST.lead) * (height - top - bottom)];
}

function axes(): SVGElement[] {
  const { width, height, left, right, top, bottom } = SIZE;
  const across = [0, 10, 20, 30, 40, 50].map((wrong) => {
    const [x] = place({ threshold: 0.5, right: 0, wrong, lead: 0 });
    return shape("text", { x, y: height - bottom + 16, "text-anchor": "middle" }, `${wrong}%`);
  });
  const down = [0, 200, 400, 600, 800].flatMap((lead) => {
    const [, y] = place({ threshold: 0.5, right: 0, wrong: 0, lead });
    return [
      shape("line", { class: "grid-line", x1: left, x2: width - right, y1: y, y2: y }),
      shape("text", { x: left - 8, y: y + 4, "text-anchor": "end" }, `${lead / 1000} s`),
    ];
  });
  const title = shape("text", { x: (left + width - right) / 2, y: height - 6, "text-anchor": "middle" }, "wrong selections");
  const named = shape("text", { x: 0, y: top - 8 }, "before the press");
  return [...down, ...across, title, named];
}

function shape(name: string, attributes: Readonly<Record<string, string | number>>, text?: string): SVGElement {
  const element = document.createElementNS(SVG, name);
  for (const [key, value] of Object.entries(attributes)) element.setAttribute(key, String(value));
  if (text !== undefined) element.textContent = text;
  return element;
}

function rowOf({ name, movements, people }: RecordedSet, mark: string): { row: HTMLElement; cells: HTMLElement[] } {
  const row = document.createElement("tr");
  const head = document.createElement("th");
  head.scope = "row";
  const size = document.createElement("span");
  size.className = "set-size";
  size.textContent = `${movements} movements of ${people} people`;
  head.append(`${mark}  ${name}`, size);
  const cells = ["share right", "share wrong", "time"].map((kind) => {
    const cell = document.createElement("td");
    cell.className = `figure ${kind}`;
    return cell;
  });
  row.append(head, ...cells);
  return { row, cells };
}
