/** The arrival as a strip of the bay's clock: its density, the interval that holds it with 80%, and now. */
import { timeOfDay } from "./clock.ts";
import type { Arriving } from "./lookout.ts";
import type { Paper } from "./paper.ts";

const HALF_HOUR = 1800;

/** `arriving` is null where nothing can be expected. */
export function drawArrival(
  { context, width, height, colours, rem, family }: Paper,
  now: number,
  arriving: Arriving | null,
): void {
  context.clearRect(0, 0, width, height);
  const bottom = height - 1.25 * rem;
  const from = Math.floor(now / HALF_HOUR) * HALF_HOUR;
  // as far as there is any probability, in hours
  const last = arriving ? arriving.high + 0.6 * (arriving.high - arriving.low) : now;
  const hours = Math.max(1, Math.ceil((last - from) / (2 * HALF_HOUR)));
  const to = from + hours * 2 * HALF_HOUR;
  const across = (time: number) => 0.5 * rem + ((time - from) / (to - from)) * (width - rem);

  context.strokeStyle = colours.line;
  context.lineWidth = 1;
  context.beginPath();
  context.moveTo(across(from), bottom + 0.5);
  context.lineTo(across(to), bottom + 0.5);
  context.stroke();
  context.font = `${0.6875 * rem}px ${family}`;
  context.fillStyle = colours.muted;
  context.textAlign = "center";
  context.textBaseline = "top";
  const step = hours > 2 ? 2 * HALF_HOUR : HALF_HOUR;
  for (let time = Math.ceil(from / step) * step; time <= to; time += step) {
    const x = Math.min(width - 1.3 * rem, Math.max(1.3 * rem, across(time)));
    context.fillText(timeOfDay(time), x, bottom + 0.35 * rem);
    context.beginPath();
    context.moveTo(across(time), bottom);
    context.lineTo(across(time), bottom - 0.25 * rem);
    context.stroke();
  }

  if (arriving) {
    const { times, probabilities, low, high, median } = arriving;
    const highest = probabilities.reduce((most, probability) => Math.max(most, probability), 1e-9);
    const up = (probability: number) => bottom - (probability / highest) * (bottom - 0.5 * rem);
    const curve = (since: number, until: number) => {
      context.beginPath();
      context.moveTo(across(since), bottom);
      for (const [i, time] of times.entries())
        if (time >= since && time <= until) context.lineTo(across(time), up(probabilities[i] ?? 0));
      context.lineTo(across(until), bottom);
      context.closePath();
      context.fill();
    };
    context.fillStyle = colours.light;
    context.globalAlpha = 0.22;
    curve(Math.max(now, times[0] ?? now), Math.min(to, times.at(-1) ?? to));
    context.globalAlpha = 0.55;
    curve(low, high);
    context.globalAlpha = 1;
    context.strokeStyle = colours.light;
    context.lineWidth = 2;
    context.beginPath();
    context.moveTo(across(median), bottom);
    context.lineTo(across(median), 0.25 * rem);
    context.stroke();
  }
  context.fillStyle = colours.text;
  context.beginPath();
  context.arc(across(now), bottom, 0.25 * rem, 0, 2 * Math.PI);
  context.fill();
}
