/** What the predictor is given: method, arrival prior, noise, the prior of "none of them". */
import type { Method } from "whither";
import { showValue } from "../shared/slider.ts";
import { DEFAULT, METHODS, type Settings } from "./scenario.ts";

export class Controls {
  readonly #form: HTMLFormElement;
  readonly #changed: (settings: Settings) => void;

  constructor(form: HTMLFormElement, changed: (settings: Settings) => void) {
    this.#form = form;
    this.#changed = changed;
    const select = this.#select("method");
    for (const { method, name } of METHODS) select.add(new Option(name, method));
    this.#set(DEFAULT);
    form.addEventListener("input", () => this.#apply());
    form.addEventListener("reset", (event) => {
      event.preventDefault();
      this.#set(DEFAULT);
      this.#apply();
    });
    form.addEventListener("submit", (event) => event.preventDefault());
  }

  #apply(): void {
    this.#show();
    this.#changed(this.#read());
  }

  #set({ method, arrival, noise, none }: Settings): void {
    this.#select("method").value = method;
    this.#select("prior").value = arrival;
    this.#slider("noise").value = String(Math.log10(noise));
    this.#slider("none").value = String(Math.log10(none));
    this.#show();
  }

  #read(): Settings {
    return {
      method: this.#select("method").value as Method,
      arrival: this.#select("prior").value as Settings["arrival"],
      noise: rounded(10 ** Number(this.#slider("noise").value)),
      none: rounded(10 ** Number(this.#slider("none").value)),
    };
  }

  #show(): void {
    const { method, arrival, noise, none } = this.#read();
    showValue(this.#form, "noise", `${noise} m/s^1.5`);
    showValue(this.#form, "none", String(none));
    // what accumulates evidence for each arrival time cannot have a prior that moves on
    const accumulates = (one: string) => METHODS.some((known) => known.method === one && known.accumulates);
    for (const option of this.#select("method").options) option.disabled = arrival === "horizon" && accumulates(option.value);
    for (const option of this.#select("prior").options) option.disabled = option.value === "horizon" && accumulates(method);
  }

  #select(name: string): HTMLSelectElement {
    return this.#form.elements.namedItem(name) as HTMLSelectElement;
  }

  #slider(name: string): HTMLInputElement {
    return this.#form.elements.namedItem(name) as HTMLInputElement;
  }
}

/** To two figures, so that a logarithmic slider gives back what it was set to. */
function rounded(value: number): number {
  return Number(value.toPrecision(2));
}
