/** The sliders of the model; spreads and noise are set on logarithmic scales. */
import { showValue } from "../shared/slider.ts";
import type { Settings } from "./airliner.ts";
import { length } from "./length.ts";

type Sliders = Omit<Settings, "waypoint">;

export class Controls {
  readonly #form: HTMLFormElement;

  constructor(form: HTMLFormElement, initial: Sliders, changed: (settings: Sliders) => void) {
    this.#form = form;
    this.set(initial);
    form.addEventListener("input", () => {
      this.#show();
      changed(this.#read());
    });
    form.addEventListener("submit", (event) => event.preventDefault());
  }

  set({ noise, origin, destination, correlation }: Sliders): void {
    this.#field("noise").value = String(Math.log10(noise));
    this.#field("origin").value = String(Math.log10(origin));
    this.#field("destination").value = String(Math.log10(destination));
    this.#field("correlation").value = String(correlation);
    this.#show();
  }

  #field(name: string): HTMLInputElement {
    return this.#form.elements.namedItem(name) as HTMLInputElement;
  }

  #read(): Sliders {
    const number = (name: string) => Number(this.#field(name).value);
    return {
      noise: 10 ** number("noise"),
      origin: 10 ** number("origin"),
      destination: 10 ** number("destination"),
      correlation: number("correlation"),
    };
  }

  #show(): void {
    const { noise, origin, destination, correlation } = this.#read();
    showValue(this.#form, "noise", String(Number(noise.toPrecision(2))));
    showValue(this.#form, "origin", length(origin));
    showValue(this.#form, "destination", length(destination));
    showValue(this.#form, "correlation", correlation.toFixed(2));
  }
}
