/** Puts the page together. */
import { Demonstration } from "./demonstration.ts";
import { PLACES } from "./destinations.ts";
import example from "./example.js?raw";
import { haunt } from "./ghost.ts";
import { listPapers } from "./papers.ts";
import { ProbabilityList } from "./view/probabilities.ts";
import { Chart } from "./view/chart.ts";
import { controls } from "./view/controls.ts";
import { Fan } from "./view/fan.ts";
import { Numbers } from "./view/numbers.ts";
import { begin, part, reasonOf } from "../shared/page.ts";
import { onResolution } from "../shared/resolution.ts";
import { Screen } from "./view/screen.ts";
import { INVITATIONS } from "./view/sentences.ts";
import { theme } from "../shared/theme.ts";
import { Status } from "../shared/status.ts";

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
  const { exampleOf, init } = await import("./idle.ts");
  await init();
  await document.fonts.ready;
  const invitation = matchMedia("(pointer: coarse)").matches ? INVITATIONS.coarse : INVITATIONS.fine;
  const numbers = new Numbers({
    lead: part("lead"),
    median: part("median"),
    right: part("early-right"),
    wrong: part("early-wrong"),
    presses: part("presses"),
  });
  const demonstration = new Demonstration(labels, invitation, {
    screen,
    fan,
    chart,
    status,
    probabilityList: new ProbabilityList(
      { rows: part("rows"), none: part("none"), remaining: part("remaining"), interval: part("interval") },
      labels,
    ),
    numbers,
  });

  controls(part<HTMLFormElement>("controls"), (settings) => {
    demonstration.configure(settings).catch((error: unknown) => {
      status.write(`These settings could not be loaded: ${reasonOf(error)}`, true);
    });
  });
  screen.onPress((index, pointed) => demonstration.press(index, pointed));

  onResolution(() => {
    fan.fit();
    chart.restyle();
  });
  new ResizeObserver(() => fan.fit()).observe(part("screen"));

  const example = exampleOf(screen.measure(), labels, EXAMPLE.from, EXAMPLE.to);
  if (example) {
    chart.draw(example.moments, example.press, true);
    numbers.example(example.press);
  }
  if (!matchMedia("(prefers-reduced-motion: reduce)").matches) {
    const svg = (selector: string) => part("ghost").querySelector<SVGElement>(selector) as SVGElement;
    haunt({ root: part("ghost"), arrow: svg(".arrow"), trail: svg(".trail") }, demonstration.stage());
  }
}

begin(status, start);
