/** Puts the page together: from pointer events to predictions to what is drawn. */
import { init } from "whither";
import { DEFAULTS } from "./belief/settings.ts";
import { Predictions } from "./belief/predictions.ts";
import { Demonstration } from "./demonstration.ts";
import { PLACES } from "./destinations.ts";
import example from "./example.js?raw";
import { haunt } from "./ghost.ts";
import { listen } from "./movement/pointers.ts";
import { listPapers } from "./papers.ts";
import { ProbabilityList } from "./view/probabilities.ts";
import { Chart } from "./view/chart.ts";
import { controls } from "./view/controls.ts";
import { Fan } from "./view/fan.ts";
import { Numbers } from "./view/numbers.ts";
import { onResolution } from "../shared/resolution.ts";
import { Screen } from "./view/screen.ts";
import { INVITATIONS } from "./view/sentences.ts";
import { theme } from "../shared/theme.ts";
import { Status } from "../shared/status.ts";

/** An element that index.html promises. */
function part<T extends HTMLElement = HTMLElement>(id: string): T {
  return document.getElementById(id) as T;
}

/** The movement that the chart shows before there is another one: across the screen. */
const EXAMPLE = { from: PLACES.findIndex(({ id }) => id === "fuel"), to: PLACES.findIndex(({ id }) => id === "seats") };

const labels = PLACES.map((place) => place.label);
const status = new Status(part("status"), part("announcement"));
const screen = new Screen(part("screen"), part("grid"), PLACES);
const fan = new Fan(part<HTMLCanvasElement>("fan"));
const chart = new Chart(part("chart"), labels);

part("listing").textContent = example.trim();
listPapers(part("paper-list"));
theme(part<HTMLButtonElement>("theme"), () => {
  fan.fit();
  chart.restyle();
});

async function start(): Promise<void> {
  await init();
  await document.fonts.ready;
  const predictions = new Predictions(screen.measure(), DEFAULTS);
  const invitation = matchMedia("(pointer: coarse)").matches ? INVITATIONS.coarse : INVITATIONS.fine;
  const demonstration = new Demonstration(predictions, DEFAULTS, labels, invitation, {
    screen,
    fan,
    chart,
    status,
    probabilityList: new ProbabilityList(
      { rows: part("rows"), none: part("none"), remaining: part("remaining"), interval: part("interval") },
      labels,
    ),
    numbers: new Numbers(
      {
        lead: part("lead"),
        median: part("median"),
        right: part("early-right"),
        wrong: part("early-wrong"),
        presses: part("presses"),
      },
      labels,
    ),
  });

  controls(part<HTMLFormElement>("controls"), (settings) => {
    try {
      demonstration.configure(settings);
    } catch (error) {
      status.write(`These settings do not go together: ${reasonOf(error)}`, true);
    }
  });
  screen.onKeyPress((index) => demonstration.pressWithoutPointer(index));
  listen(() => screen.corner(), {
    move: (pointerId, samples) => demonstration.move(pointerId, samples),
    press: (pointerId, sample, target) => demonstration.press(pointerId, sample, screen.iconOf(target)),
    lost: (pointerId) => demonstration.lose(pointerId),
    gone: (pointerId) => demonstration.forget(pointerId),
    hidden: () => demonstration.hide(),
  });

  const fit = () => {
    fan.fit();
    demonstration.place();
  };
  onResolution(() => {
    fit();
    chart.restyle();
  });
  const sizes = new ResizeObserver(fit);
  sizes.observe(part("screen"));
  sizes.observe(part("grid"));

  demonstration.example(EXAMPLE.from, EXAMPLE.to);
  if (!matchMedia("(prefers-reduced-motion: reduce)").matches) {
    const svg = (selector: string) => part("ghost").querySelector<SVGElement>(selector) as SVGElement;
    haunt({ root: part("ghost"), arrow: svg(".arrow"), trail: svg(".trail") }, demonstration.ghost());
  }
}

function reasonOf(error: unknown): string {
  return error instanceof Error ? error.message : String(error);
}

start().catch((error: unknown) => {
  status.write(`The predictor could not start: ${reasonOf(error)}`, true);
  document.documentElement.dataset["failed"] = "true";
});
