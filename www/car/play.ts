/** Puts together what predicts: the watchers and what shows them, the controls, the ghost. */
import { Demonstration, type Views } from "./demonstration.ts";
import { PLACES } from "../shared/places.ts";
import type { DeviceName } from "./devices.ts";
import { haunt } from "./ghost.ts";
import { handOn } from "./shaken.ts";
import { Chart } from "./view/chart.ts";
import { controls, type Controlled } from "./view/controls.ts";
import { Cursor } from "./view/cursor.ts";
import { Fan } from "./view/fan.ts";
import { percent } from "../shared/format.ts";
import { Numbers } from "./view/numbers.ts";
import { ProbabilityList } from "./view/probabilities.ts";
import type { Screen } from "./view/screen.ts";
import { INVITATIONS } from "./view/sentences.ts";
import { Tradeoff } from "./view/tradeoff.ts";
import { part, reasonOf } from "../shared/page.ts";
import { onResolution } from "../shared/resolution.ts";
import type { Status } from "../shared/status.ts";

/** The movement that is shown before there is another one: the first of these that is predicted right, at this size of the screen. */
const EXAMPLES = [
  ["fuel", "seats"],
  ["help", "phone"],
  ["connections", "phone"],
  ["navigation", "messages"],
] as const;

/** Begins, and gives what is to be called where the theme has changed. */
export async function play(screen: Screen, status: Status): Promise<() => void> {
  // it has the core, which the watchers load too
  const { exampleOf, init } = await import("./idle.ts");
  await init();
  await document.fonts.ready;
  const labels = PLACES.map((place) => place.label);
  const fan = new Fan(part<HTMLCanvasElement>("fan"));
  const chart = new Chart(part("chart"), labels);
  const touch = matchMedia("(pointer: coarse)").matches;
  const numbers = new Numbers({
    caption: part("lead"),
    median: part("median"),
    right: part("early-right"),
    wrong: part("early-wrong"),
    presses: part("presses"),
  });
  const probabilityList = new ProbabilityList(
    {
      root: part("panel"),
      note: part("panel-note"),
      rows: part("rows"),
      none: part("none"),
      remaining: part("remaining"),
      interval: part("interval"),
    },
    labels,
  );
  const demonstration = new Demonstration(labels, touch ? INVITATIONS.coarse : INVITATIONS.fine, {
    screen,
    fan,
    chart,
    status,
    probabilityList,
    numbers,
    tally: part("tally"),
  });
  const controlled = connect(demonstration, { screen, status }, touch ? "touch" : "mouse");
  screen.onPress((index, pointed) => demonstration.press(index, pointed));

  const restyle = () => {
    fan.fit();
    chart.restyle();
  };
  onResolution(restyle);
  new ResizeObserver(() => fan.fit()).observe(part("screen"));

  const at = (id: string) => PLACES.findIndex((place) => place.id === id);
  const examples = EXAMPLES.map(([from, to]) => exampleOf(screen.measure(), labels, at(from), at(to)));
  const example = examples.find((each) => each?.press.verdict === "right") ?? examples[0];
  if (example) {
    chart.draw(example.moments, example.press, true);
    probabilityList.example(example.posterior, "An example, until you move");
    numbers.example();
  }
  if (!matchMedia("(prefers-reduced-motion: reduce)").matches)
    haunt(
      new Cursor(part("ghost")),
      demonstration.stage(() => controlled().ride),
    );
  return restyle;
}

/** Connects the controls, and gives what reads what they are set to. `device` is what the visitor points with, as far as the browser knows. */
function connect(
  demonstration: Demonstration,
  { screen, status }: Pick<Views, "screen" | "status">,
  device: DeviceName,
): () => Controlled {
  const tradeoff = new Tradeoff({
    drawing: part<SVGSVGElement>("curves"),
    rows: part("recorded"),
    sentence: part("worth"),
    date: part("measured"),
    command: part("command"),
  });
  const cursor = new Cursor(part("hand"));
  let now: Controlled | null = null;
  let stop: (() => void) | null = null;
  const read = () => now as Controlled;
  controls(part<HTMLFormElement>("controls"), device, (controlled) => {
    const before = now;
    now = controlled;
    const { settings, ride, selecting } = controlled;
    tradeoff.show(settings.threshold);
    part("threshold-now").textContent = percent(settings.threshold);
    if (before && before.selecting !== selecting) demonstration.select(selecting);
    const handedOn = ride.amplitude > 0 || ride.device !== device;
    if (handedOn !== (stop !== null)) {
      stop?.();
      stop = handedOn
        ? handOn(
            part("screen"),
            cursor,
            () => read().ride,
            () => screen.corner(),
          )
        : null;
      demonstration.follow(handedOn);
    }
    demonstration.configure(settings).catch((error: unknown) => {
      status.write(`These settings could not be loaded: ${reasonOf(error)}`, true);
    });
  });
  return read;
}
