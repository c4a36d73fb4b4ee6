/** The folded controls: method, noise, quadrature points, threshold. */
import type { Method } from "whither";
import { DEFAULTS, METHODS, pointsOf, type Settings } from "../model/settings.ts";
import { percent } from "./format.ts";
import { showValue } from "../../shared/slider.ts";

export function controls(form: HTMLFormElement, changed: (settings: Settings) => void): void {
  const field = (name: string) => form.elements.namedItem(name) as HTMLInputElement | HTMLSelectElement | HTMLOutputElement;
  const method = field("method") as HTMLSelectElement;
  method.append(...METHODS.map((each) => new Option(each.label, each.method)));
  field("noise").value = String(DEFAULTS.noise);
  field("points").value = String(DEFAULTS.points);
  field("threshold").value = String(DEFAULTS.threshold);

  const read = (): Settings => ({
    method: method.value as Method,
    noise: Number(field("noise").value),
    points: Number(field("points").value),
    threshold: Number(field("threshold").value),
  });
  const show = (settings: Settings) => {
    showValue(form, "noise", `× ${(2 ** settings.noise).toFixed(2)}`);
    showValue(form, "points", String(settings.points));
    showValue(form, "threshold", percent(settings.threshold));
  };

  method.addEventListener("input", () => {
    field("points").value = String(pointsOf(read().method));
  });
  form.addEventListener("input", () => {
    const settings = read();
    show(settings);
    changed(settings);
  });
  form.addEventListener("submit", (event) => event.preventDefault());
  show(read());
}
