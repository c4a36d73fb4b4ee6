/** The folded controls: the model, and the car around it. The threshold has its slider where its worth is shown, in the same form. */
import type { Method } from "whither";
import {
  ARRIVALS,
  DEFAULTS,
  METHODS,
  MOTIONS,
  pointsOf,
  type ArrivalType,
  type MotionType,
  type Settings,
} from "../model/settings.ts";
import { DEVICES, type DeviceName, type Ride } from "../devices.ts";
import { showValue } from "../../shared/slider.ts";
import { percent } from "../../shared/format.ts";
import { positionOf, thresholdAt } from "./tradeoff.ts";

/** What the controls set. */
export interface Controlled {
  readonly settings: Settings;
  readonly ride: Ride;
  /** Whether icons are selected when the ring closes. */
  readonly selecting: boolean;
}

/** Calls back with what is set, now and whenever it changes. */
export function controls(form: HTMLFormElement, device: DeviceName, changed: (controlled: Controlled) => void): void {
  const field = (name: string) => form.elements.namedItem(name) as HTMLInputElement | HTMLSelectElement;
  const isChecked = (name: string) => (field(name) as HTMLInputElement).checked;
  const number = (name: string) => Number(field(name).value);
  const choose = (name: string, options: readonly (readonly [value: string, label: string])[], value: string) => {
    const select = field(name) as HTMLSelectElement;
    select.append(...options.map(([each, label]) => new Option(label, each)));
    select.value = value;
  };
  choose(
    "method",
    METHODS.map(({ method, label }) => [method, label]),
    DEFAULTS.method,
  );
  choose(
    "motion",
    MOTIONS.map(({ motion, label }) => [motion, label]),
    DEFAULTS.motion,
  );
  choose(
    "arrival",
    ARRIVALS.map(({ arrival, label }) => [arrival, label]),
    DEFAULTS.arrival,
  );
  choose(
    "device",
    DEVICES.map(({ name, label }) => [name, label]),
    device,
  );
  for (const name of ["noise", "points", "none"] as const) field(name).value = String(DEFAULTS[name]);
  field("threshold").value = String(positionOf(DEFAULTS.threshold));

  const read = (): Controlled => {
    const ride = { device: field("device").value as DeviceName, amplitude: number("amplitude"), frequency: number("frequency") };
    return {
      settings: {
        method: field("method").value as Method,
        motion: field("motion").value as MotionType,
        arrival: field("arrival").value as ArrivalType,
        noise: number("noise"),
        points: number("points"),
        none: number("none"),
        shake: isChecked("expected") ? ride.amplitude : 0,
        threshold: thresholdAt(number("threshold")),
      },
      ride,
      selecting: isChecked("selecting"),
    };
  };
  const show = ({ settings, ride }: Controlled) => {
    showValue(form, "noise", `× ${(2 ** settings.noise).toFixed(2)}`);
    showValue(form, "points", String(settings.points));
    showValue(form, "none", percent(settings.none));
    showValue(form, "threshold", percent(settings.threshold));
    showValue(form, "amplitude", ride.amplitude === 0 ? "smooth" : `${ride.amplitude} px`);
    showValue(form, "frequency", `${ride.frequency} Hz`);
    const tuned = settings.method === "pointing";
    for (const name of ["motion", "arrival"]) field(name).disabled = tuned;
    // the papers' methods know of no road
    field("expected").disabled = !tuned;
  };
  const report = () => {
    const controlled = read();
    show(controlled);
    changed(controlled);
  };

  field("method").addEventListener("input", () => {
    field("points").value = String(pointsOf(read().settings.method));
  });
  // the threshold's slider is elsewhere on the page, and belongs to the form
  form.addEventListener("input", report);
  field("threshold").addEventListener("input", report);
  form.addEventListener("submit", (event) => event.preventDefault());
  report();
}
