/** The harbour master's board: for each harbour the vessels that are next, earliest first. */
import { timeOfDay } from "./clock.ts";
import { HARBOURS } from "./coast.ts";
import type { Arrival, Followed } from "./harbour-master.ts";
import { percent } from "./words.ts";

/** Lines of each harbour. */
const LINES = 4;

interface Line {
  readonly element: HTMLElement;
  readonly time: HTMLElement;
  readonly vessel: HTMLButtonElement;
  readonly detail: HTMLElement;
}

export class Board {
  readonly #lines: readonly (readonly Line[])[];
  readonly #due: readonly HTMLElement[];
  readonly #shown = new Map<HTMLButtonElement, Followed>();

  /** `chosen` is called with the vessel that is to be followed. */
  constructor(parent: HTMLElement, chosen: (vessel: Followed) => void) {
    const harbours = HARBOURS.map(({ id, name }) => {
      const heading = make("h3", "berth-name", name);
      const due = make("p", "berth-due figure", "–");
      const list = make("ol", "berth-list");
      list.setAttribute("aria-label", `Next arrivals at ${name}`);
      const lines = Array.from({ length: LINES }, () => line(list));
      const berth = make("section", "berth");
      berth.dataset["harbour"] = id;
      berth.append(heading, due, list);
      parent.append(berth);
      return { due, lines };
    });
    this.#lines = harbours.map(({ lines }) => lines);
    this.#due = harbours.map(({ due }) => due);
    parent.addEventListener("click", ({ target }) => {
      const button = target instanceof Element ? target.closest("button") : null;
      const vessel = button && this.#shown.get(button);
      if (vessel) chosen(vessel);
    });
  }

  show(boards: readonly (readonly Arrival[])[], due: Float64Array, followed: Followed | null): void {
    for (const [index, lines] of this.#lines.entries()) {
      write(this.#due[index], `${(due[index] ?? 0).toFixed(1)} expected`);
      for (const [rank, { element, time, vessel, detail }] of lines.entries()) {
        const arrival = boards[index]?.[rank];
        element.classList.toggle("empty", !arrival);
        vessel.disabled = !arrival;
        write(time, arrival ? timeOfDay(arrival.median) : "–");
        write(vessel, arrival ? arrival.vessel.name : "no more");
        write(detail, arrival ? `${percent(arrival.probability)}, ${timeOfDay(arrival.low)} to ${timeOfDay(arrival.high)}` : "");
        if (arrival) {
          this.#shown.set(vessel, arrival.vessel);
          vessel.setAttribute("aria-pressed", String(arrival.vessel === followed));
        } else {
          this.#shown.delete(vessel);
          vessel.removeAttribute("aria-pressed");
        }
      }
    }
  }
}

function line(list: HTMLElement): Line {
  const element = make("li", "berth-line empty");
  const time = make("span", "berth-time figure", "–");
  const vessel = make("button", "berth-vessel", "no more");
  vessel.type = "button";
  vessel.disabled = true;
  const detail = make("span", "berth-detail figure");
  element.append(time, vessel, detail);
  list.append(element);
  return { element, time, vessel, detail };
}

function make<Name extends keyof HTMLElementTagNameMap>(name: Name, className: string, text = ""): HTMLElementTagNameMap[Name] {
  const element = document.createElement(name);
  element.className = className;
  element.textContent = text;
  return element;
}

function write(element: HTMLElement | undefined, text: string): void {
  if (element && element.textContent !== text) element.textContent = text;
}
