/**
 * The posterior now: the most probable targets, none of them, and when the pointer arrives.
 *
 * @module
 */
import type { Snapshot } from "#dom";
import { draw, duration, make, percent, write } from "../elements.js";
import type { Subject } from "../subject.js";

/** So many targets have a line. */
const LINES = 5;

/** Seconds that the axis of arrival has. */
const AXIS = 1.5;

export interface Part {
  readonly element: HTMLElement;
  /** Shows what there is now. */
  update(subject: Subject): void;
}

export function now(): Part {
  const lines = Array.from({ length: LINES }, () => line());
  const none = line("none");
  write(none.name, "None of them");
  const arrival = arrivalOf();
  const element = make("div", { className: "now" }, ...lines.map(({ row }) => row), none.row, arrival.element);
  let shown: Snapshot | null = null;
  let of: Subject | null = null;
  return {
    element,
    update(subject) {
      const snapshot = subject.watcher.getSnapshot();
      // between movements the last posterior stays, to be read
      element.classList.toggle("past", !snapshot.moving);
      if (subject === of && (snapshot === shown || !snapshot.moving)) return;
      [shown, of] = [snapshot, subject];
      const { targets, none: share, moving, intended } = snapshot;
      lines.forEach((each, i) => {
        const probable = targets[i];
        each.set(probable ? subject.nameOf(probable.target) : "", probable?.probability ?? null);
        each.row.toggleAttribute("data-intended", probable !== undefined && intended.includes(probable.target));
      });
      none.set("None of them", moving ? share : null);
      arrival.update(subject);
    },
  };
}

/** A name, a bar and a figure. */
function line(kind = "") {
  const name = make("span", {});
  const fill = make("i", {});
  const figure = make("span", {});
  const row = make("div", { className: `row ${kind}` }, name, make("div", { className: "bar" }, fill), figure);
  return {
    row,
    name,
    set(text: string, share: number | null): void {
      write(name, text || "–");
      write(figure, share === null ? "" : percent(share));
      fill.style.transform = `scaleX(${(share ?? 0).toFixed(3)})`;
    },
  };
}

/** The time to go: its middle and the interval in which it is four times in five. */
function arrivalOf(): Part {
  const figure = make("output", {});
  const band = draw("rect", { y: 3, height: 6, rx: 3, fill: "var(--light)", stroke: "none", opacity: 0.45 });
  const middle = draw("path", { d: "M0 1V11", stroke: "var(--light)", "stroke-width": 2.5 });
  const ticks = [0, 0.5, 1, 1.5].map((seconds) => {
    const x = at(seconds);
    const anchor = seconds === 0 ? "start" : seconds === AXIS ? "end" : "middle";
    const label = draw("text", { x, y: 21, "text-anchor": anchor }, seconds === AXIS ? `${seconds} s` : String(seconds));
    return draw("g", {}, draw("path", { d: `M${x} 6V9` }), label);
  });
  const axis = draw("path", { d: "M0 6H300" });
  const chart = draw("svg", { class: "plot", viewBox: "0 0 300 24", "aria-hidden": "true" }, axis, ...ticks, band, middle);
  const time = make("div", { className: "time" });
  time.append(chart);
  const element = make("div", { className: "arrival" }, make("span", {}, "Arrival"), figure, time);
  return {
    element,
    update({ watcher }) {
      const { remaining } = watcher;
      for (const mark of [band, middle]) mark.toggleAttribute("hidden", !remaining);
      write(figure, remaining ? `${duration(remaining.mean)} (${duration(remaining.low)} to ${duration(remaining.high)})` : "–");
      if (!remaining) return;
      const [low, high] = [at(remaining.low), at(remaining.high)];
      band.setAttribute("x", String(low));
      band.setAttribute("width", String(Math.max(6, high - low)));
      middle.setAttribute("transform", `translate(${at(remaining.mean)})`);
    },
  };
}

/** Where a time is on the axis. */
function at(seconds: number): number {
  return Math.round((3000 * Math.min(seconds, AXIS)) / AXIS) / 10;
}
