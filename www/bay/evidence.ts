/** Below the chart: the probabilities since the first report, one band over another, and the prediction error with its limit. */
import { LIMIT, type Anomaly } from "./anomaly.ts";
import { timeOfDay } from "./clock.ts";
import { HARBOURS } from "./coast.ts";
import type { Moment } from "./lookout.ts";
import type { Paper } from "./paper.ts";

/** The least time that is shown, in seconds. */
const SHORTEST = 3600;
/** The most deviations that are shown. */
const CEILING = 14;
const BANDS = [
  ["band-1", "on-light"],
  ["band-2", "on-band"],
  ["band-3", "on-light"],
  ["band-4", "on-band"],
  ["band-5", "on-light"],
] as const;

/** A name is put at one of so many moments. */
const STRIDE = 8;

/** A rectangle of the canvas. */
interface Box {
  readonly left: number;
  readonly right: number;
  readonly top: number;
  readonly bottom: number;
}

export function drawEvidence(
  paper: Paper,
  moments: readonly Moment[],
  anomalies: readonly Anomaly[],
  { from, to }: { from: number; to: number },
): void {
  const { context, width, height, rem } = paper;
  context.clearRect(0, 0, width, height);
  const [left, right] = [2.75 * rem, width - 0.5 * rem];
  const bands: Box = { left, right, top: 0.5 * rem, bottom: height * 0.58 };
  const errors: Box = { left, right, top: bands.bottom + 1.5 * rem, bottom: height - 1.75 * rem };
  const end = Math.max(to, from + SHORTEST);
  const across = (time: number) => left + ((time - from) / (end - from)) * (right - left);
  drawBands(paper, bands, moments, across);
  drawErrors(paper, errors, moments, across);
  drawTimes(paper, { ...errors, top: bands.top }, { from, end }, across);
  drawAnomalies(paper, bands, anomalies, across);
}

/** The most probable harbour of now is lit. */
function drawBands(
  { context, colours, rem, family }: Paper,
  box: Box,
  moments: readonly Moment[],
  across: (time: number) => number,
): void {
  const up = (share: number) => box.bottom - share * (box.bottom - box.top);
  const latest = moments.at(-1);
  const others = HARBOURS.map((_, index) => index).filter((index) => index !== latest?.best);
  const order = latest ? [latest.best, ...others] : [];
  const base = moments.map(() => 0);
  for (const [rank, index] of order.entries()) {
    const lower = [...base];
    for (const [k, { probabilities }] of moments.entries()) base[k] = (base[k] ?? 0) + (probabilities[index] ?? 0);
    context.beginPath();
    moments.forEach(({ report }, k) => context.lineTo(across(report.time), up(base[k] ?? 0)));
    for (let k = moments.length - 1; k >= 0; k -= 1) context.lineTo(across(moments[k]?.report.time ?? 0), up(lower[k] ?? 0));
    context.closePath();
    const [band, ink] = BANDS[rank === 0 ? 0 : 1 + ((rank - 1) % (BANDS.length - 1))] ?? BANDS[0];
    context.fillStyle = colours[band];
    context.fill();
    name(colours[ink], HARBOURS[index]?.name ?? "", lower, base);
  }
  if (moments.length > 1)
    name(
      colours.muted,
      "none of them",
      base,
      base.map(() => 1),
    );
  context.strokeStyle = colours.line;
  context.lineWidth = 1;
  context.strokeRect(box.left, box.top, box.right - box.left, box.bottom - box.top);
  label("100%", up(1) + 0.4 * rem);
  label("0%", up(0) - 0.4 * rem);

  /** In a band where it is thickest, if there is room. */
  function name(colour: string, text: string, lower: readonly number[], upper: readonly number[]): void {
    context.font = `500 ${0.75 * rem}px ${family}`;
    const half = context.measureText(text).width / 2 + 0.25 * rem;
    const last = across(latest?.report.time ?? 0);
    const xs = moments.map(({ report }) => across(report.time));
    const rooms = xs.map((_, k) => (upper[k] ?? 0) - (lower[k] ?? 0));
    let best = { k: -1, room: 0 };
    for (const [k, x] of xs.entries()) {
      if (k % STRIDE || x - half < box.left || x + half > last) continue;
      const room = rooms.reduce((least, one, i) => (Math.abs((xs[i] ?? 0) - x) <= half ? Math.min(least, one) : least), 1);
      if (room > best.room) best = { k, room };
    }
    if (best.room * (box.bottom - box.top) < 1.5 * rem) return;
    context.fillStyle = colour;
    context.textAlign = "center";
    context.textBaseline = "middle";
    const middle = up(((lower[best.k] ?? 0) + (upper[best.k] ?? 0)) / 2);
    context.fillText(text, across(moments[best.k]?.report.time ?? 0), middle);
  }

  function label(text: string, y: number): void {
    context.font = `${0.6875 * rem}px ${family}`;
    context.fillStyle = colours.muted;
    context.textAlign = "right";
    context.textBaseline = "middle";
    context.fillText(text, box.left - 0.4 * rem, y);
  }
}

/** Deviations from the forecast, and the limit of the rule. */
function drawErrors(
  { context, colours, rem, family }: Paper,
  box: Box,
  moments: readonly Moment[],
  across: (time: number) => number,
): void {
  const up = (deviations: number) => box.bottom - (Math.min(CEILING, deviations) / CEILING) * (box.bottom - box.top);
  context.strokeStyle = colours.line;
  context.lineWidth = 1;
  context.strokeRect(box.left, box.top, box.right - box.left, box.bottom - box.top);
  context.setLineDash([4, 4]);
  context.strokeStyle = colours.rest;
  context.beginPath();
  context.moveTo(box.left, up(LIMIT));
  context.lineTo(box.right, up(LIMIT));
  context.stroke();
  context.setLineDash([]);
  context.strokeStyle = colours.text;
  context.lineWidth = 1.5;
  context.lineJoin = "round";
  context.beginPath();
  for (const { report, deviations } of moments) context.lineTo(across(report.time), up(deviations));
  context.stroke();
  context.font = `${0.6875 * rem}px ${family}`;
  context.fillStyle = colours.muted;
  context.textAlign = "right";
  context.textBaseline = "middle";
  context.fillText(String(LIMIT), box.left - 0.4 * rem, up(LIMIT));
  context.fillText("0", box.left - 0.4 * rem, up(0));
  context.textAlign = "left";
  context.textBaseline = "bottom";
  context.fillText("deviations from the forecast of six minutes before", box.left, box.top - 0.2 * rem);
}

function drawTimes(
  { context, colours, rem, family }: Paper,
  box: Box,
  { from, end }: { from: number; end: number },
  across: (time: number) => number,
): void {
  const step = end - from > 3 * 3600 && box.right - box.left < 40 * rem ? 3600 : 1800;
  context.font = `${0.6875 * rem}px ${family}`;
  context.fillStyle = colours.muted;
  context.textBaseline = "top";
  context.textAlign = "center";
  for (let time = Math.ceil(from / step) * step; time <= end; time += step) {
    const x = across(time);
    if (x < box.left + rem || x > box.right - rem) continue;
    context.fillText(timeOfDay(time), x, box.bottom + 0.4 * rem);
  }
}

function drawAnomalies(
  { context, colours, rem, family }: Paper,
  box: Box,
  anomalies: readonly Anomaly[],
  across: (time: number) => number,
): void {
  for (const [index, { time }] of anomalies.entries()) {
    const x = across(time);
    context.strokeStyle = colours.text;
    context.lineWidth = 1;
    context.beginPath();
    context.moveTo(x, box.top);
    context.lineTo(x, box.bottom);
    context.stroke();
    context.beginPath();
    context.arc(x, box.top + 0.7 * rem, 0.6 * rem, 0, 2 * Math.PI);
    context.fillStyle = colours.screen;
    context.fill();
    context.stroke();
    context.fillStyle = colours.text;
    context.font = `600 ${0.6875 * rem}px ${family}`;
    context.textAlign = "center";
    context.textBaseline = "middle";
    context.fillText(String(index + 1), x, box.top + 0.72 * rem);
  }
}
