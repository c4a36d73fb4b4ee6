/**
 * Live controls: what they change holds at once, and is put back when the overlay closes.
 *
 * @module
 */
import type { WatchTarget } from "#dom";
import { make, write } from "../elements.js";
import type { Subject } from "../subject.js";
import type { Values } from "../tuning.js";
import type { Part } from "./now.js";

/** What a prior can be set to. */
const PRIORS = [0, 1 / 8, 1 / 4, 1 / 2, 1, 2, 4, 8];

/** So many targets can be chosen from. */
const MOST = 200;

export function controls(): Part {
  let subject: Subject | null = null;
  let listed: readonly WatchTarget[] = [];

  const sliders = {
    threshold: slider("Threshold", 0.01, 1),
    release: slider("Release", 0.01, 1),
    none: slider("None, prior", 0, 0.99),
  };
  const select = make("select", { "aria-label": "Target whose prior is set", on: { change: show } });
  const prior = slider("Prior of the target", 0, PRIORS.length - 1, 1, select);
  const problem = make("p", { className: "problem", role: "alert", hidden: true });
  const code = make("code", {});
  const copy = make("button", { type: "button", on: { click: copied } }, "Copy");
  const reset = make("button", { type: "button", on: { click: () => attempt(() => subject?.tuning?.restore()) } }, "Reset");
  const known = make("div", {}, ...Object.values(sliders).map(({ element }) => element), prior.element, problem);
  known.append(make("div", { className: "actions" }, code, copy, reset));
  const unknown = make("p", {}, "Shown once the core is loaded: move the pointer over the page.");
  const inside = make("div", { className: "inside" }, unknown, known);
  const element = make("details", { on: { toggle: () => subject && update(subject) } }, make("summary", {}, "Controls"), inside);

  for (const [key, { input }] of Object.entries(sliders)) {
    input.addEventListener("input", () => attempt(() => subject?.tuning?.set({ [key]: input.valueAsNumber })));
  }
  prior.input.addEventListener("input", () => {
    const target = listed[select.selectedIndex];
    if (target) attempt(() => subject?.tuning?.setPrior(target, PRIORS[prior.input.valueAsNumber] as number));
  });

  /** Does it, and shows what is wrong with it. */
  function attempt(run: () => void): void {
    let wrong = "";
    try {
      run();
    } catch (error) {
      wrong = String((error as Error).message);
    }
    problem.hidden = wrong === "";
    write(problem, wrong);
    show();
  }

  function show(): void {
    const tuning = subject?.tuning;
    unknown.hidden = Boolean(tuning);
    known.hidden = !tuning;
    if (!tuning) return;
    for (const [key, each] of Object.entries(sliders)) {
      const value = tuning.values[key as keyof Values];
      each.show(value, value.toFixed(2));
    }
    const target = listed[select.selectedIndex];
    const value = target ? tuning.prior(target) : 1;
    prior.input.disabled = !target;
    prior.show(nearest(value), value === 0 ? "never" : `×${Number(value.toPrecision(3))}`);
    reset.disabled = !tuning.isChanged;
    copy.disabled = tuning.code === "";
    if (code.textContent !== tuning.code) write(copy, "Copy");
    write(code, tuning.code);
  }

  /** The targets on the screen, to choose from. */
  function list(one: Subject): void {
    const targets = one.places.targets.slice(0, MOST);
    if (targets.length === listed.length && targets.every((target, i) => target === listed[i])) return;
    const chosen = listed[select.selectedIndex];
    listed = targets;
    select.replaceChildren(...targets.map((target) => make("option", {}, one.nameOf(target))));
    select.selectedIndex = Math.max(0, targets.indexOf(chosen as WatchTarget));
  }

  function copied(): void {
    const done = () => write(copy, "Copied");
    // where the page may not write to the clipboard, it is selected
    const select = () => getSelection()?.selectAllChildren(code);
    (navigator.clipboard?.writeText(code.textContent ?? "") ?? Promise.reject()).then(done, select);
  }

  function update(next: Subject): void {
    subject = next;
    if (!element.open) return;
    list(next);
    show();
  }

  return { element, update };
}

/** The index of the prior that is nearest. */
function nearest(value: number): number {
  const away = PRIORS.map((prior) => Math.abs(Math.log2(prior || 1 / 64) - Math.log2(value || 1 / 64)));
  return away.indexOf(Math.min(...away));
}

/** A range with its value after its name, or what stands in place of that. */
function slider(name: string, min: number, max: number, step = 0.01, first: HTMLElement = make("span", {}, name)) {
  const input = make("input", { type: "range", min: `${min}`, max: `${max}`, step: `${step}`, "aria-label": name });
  const output = make("output", {});
  return {
    element: make("div", { className: "control" }, first, input, output),
    input,
    show(value: number, text: string): void {
      if (input.valueAsNumber !== value) input.value = String(value);
      write(output, text);
      input.setAttribute("aria-valuetext", text);
    },
  };
}
