/** Puts the lab together: a field that records, workers that score and fit, what they show. */
import { begin, part, reasonOf } from "../shared/page.ts";
import { Status } from "../shared/status.ts";
import { theme } from "../shared/theme.ts";
import example from "./example.js?raw";
import { dataControls } from "./data.ts";
import { Field, type Layout } from "./field.ts";
import { Fitting } from "./fitting.ts";
import { keepMore, kept } from "./keep.ts";
import { approachOf, type Movement } from "./movement.ts";
import { Panel } from "./panel.ts";
import { Pictures } from "./pictures.ts";
import { Player } from "./player.ts";
import { hasExpected } from "./recorder.ts";
import { Sessions, type SessionName } from "./sessions.ts";
import { simulate } from "./simulated.ts";
import { Table } from "./table.ts";
import { count, leading, recorded } from "./words.ts";

/** The simulated movements that are there at once. */
const AT_FIRST = 24;
/** Those of one press of the button. */
const MORE = 20;

/** What there is to do, by the pointer that the visitor has. */
const TASK = matchMedia("(hover: none)").matches ? "drag the ring to the lit target" : "press the lit target";

const status = new Status(part("status"), part("announcement"));

begin(status, async () => {
  theme(part<HTMLButtonElement>("theme"), () => undefined);
  part("example").textContent = example;
  await document.fonts.ready;

  let shown: SessionName = "simulated";
  /** The arrangements that have an example. */
  const examples = new Set<Layout>();
  let seed = 1;
  /** The visitor's presses, which name movements. */
  let presses = 0;
  /** The visitor's last movement, until it is stated how it was predicted. */
  let fresh: string | null = null;
  let scoredFirst = (): void => undefined;
  let neverScored = (_: Error): void => undefined;
  const firstScored = new Promise<void>((resolve, reject) => ([scoredFirst, neverScored] = [resolve, reject]));

  const field = new Field(
    { field: part("field"), drawing: part<SVGSVGElement>("drawing"), handle: part("handle") },
    {
      pressed({ targets, target, recording }) {
        player.stop();
        show("own");
        const movement = recording && {
          id: `${field.layout}-${Date.now().toString(36)}-${(presses += 1)}`,
          user: "visitor",
          targets,
          target,
          samples: recording.samples,
          ...(hasExpected(recording) ? { expected: recording.expected } : {}),
        };
        if (!movement || approachOf(movement) === null) {
          status.write("Pressed, without a movement that comes to it from outside: nothing to predict from.");
          return;
        }
        fresh = movement.id;
        status.show(recorded(movement, null));
        add([movement]);
      },
      missed(by) {
        status.write(MISSED[by]);
      },
    },
  );

  const table = new Table(part<HTMLTableElement>("methods"), () => draw());
  const pictures = new Pictures({
    movement: part<SVGSVGElement>("movement"),
    course: part<SVGSVGElement>("course"),
    calibration: part<SVGSVGElement>("calibration"),
    movementWords: part("movement-words"),
    courseWords: part("course-words"),
    calibrationWords: part("calibration-words"),
  });
  const panel = new Panel(
    {
      facts: part("facts"),
      own: part<HTMLInputElement>("session-own"),
      simulated: part<HTMLInputElement>("session-simulated"),
      ownCount: part("own-count"),
      simulatedCount: part("simulated-count"),
      progress: part<HTMLProgressElement>("scoring"),
    },
    (name) => {
      player.stop();
      show(name);
    },
  );
  const fitting = new Fitting(
    {
      fit: part<HTMLButtonElement>("fit"),
      cancel: part<HTMLButtonElement>("cancel"),
      progress: part<HTMLProgressElement>("fitting"),
      verdict: part("verdict"),
      constants: part("constants"),
      code: part("constants-code"),
      copy: part<HTMLButtonElement>("copy"),
    },
    (text) => status.announce(text),
  );

  const failed = (error: unknown) => status.write(`Something does not work here: ${reasonOf(error)}`, true);
  const sessions = new Sessions({
    changed(name) {
      const { movements, waiting } = sessions.get(name);
      panel.count(name, movements.length);
      if (waiting === 0) scoredFirst();
      if (name === shown) refresh();
    },
    refused: (words) => status.write(words),
    failed(error) {
      failed(error);
      neverScored(error);
    },
  });

  /** Everything is drawn once a frame, from what is then the case. */
  let frame = 0;
  const refresh = () => {
    if (!frame) frame = requestAnimationFrame(draw);
  };
  function draw(): void {
    frame = 0;
    const session = sessions.get(shown);
    const { movements, summary, last, waiting } = session;
    panel.show(shown, session);
    table.show(summary, last, shown === "own");
    pictures.draw(summary, last, table.shown);
    field.drawPaths(movements, last);
    fitting.show(movements);
    part("leading").textContent = leading(summary?.comparison ?? null, summary?.rows ?? []);
    part<HTMLButtonElement>("export").disabled = movements.length === 0;
    document.documentElement.toggleAttribute("data-scoring", waiting > 0);
    if (!last) return;
    showExampleOf(last.movement).catch(failed);
    if (last.movement.id !== fresh) return;
    fresh = null;
    status.write(recorded(last.movement, last.trace));
  }

  function show(name: SessionName): void {
    if (name === shown) return;
    shown = name;
    fitting.clear();
    if (name === "simulated") showExample();
    refresh();
  }

  /** The simulated hand's first movements in this arrangement of the targets. */
  function showExample(): void {
    if (!examples.has(field.layout)) sessions.add("simulated", simulate(field, AT_FIRST, 1));
    examples.add(field.layout);
  }

  /** To the visitor's own. */
  function add(movements: readonly Movement[]): readonly Movement[] {
    const added = sessions.add("own", movements);
    keepMore(added).catch(failed);
    return added;
  }

  const hand = part<HTMLButtonElement>("hand");
  const player = new Player({
    moved: (path) => field.showArrow(path),
    arrived(movement, [next]) {
      sessions.add("simulated", [movement]);
      field.goOn(movement.target, next?.target ?? field.from);
    },
    ended() {
      hand.textContent = `Let the simulated hand do ${MORE}`;
    },
  });
  hand.addEventListener("click", () => {
    if (player.playing) return player.stop();
    show("simulated");
    hand.textContent = "Stop the simulated hand";
    status.write(`The simulated hand of whither/testing makes ${MORE} movements.`);
    const movements = simulate(field, MORE, (seed += 1), field.from);
    field.goOn(field.from, movements[0]?.target ?? field.from);
    player.play(movements, matchMedia("(prefers-reduced-motion: reduce)").matches);
  });

  dataControls(
    {
      keep: part<HTMLInputElement>("keep"),
      forget: part<HTMLButtonElement>("forget"),
      save: part<HTMLButtonElement>("export"),
      open: part<HTMLButtonElement>("import"),
      file: part<HTMLInputElement>("file"),
      problems: part("problems"),
    },
    {
      shown: () => ({ movements: sessions.get(shown).movements, name: shown === "own" ? "lab" : "simulated" }),
      own: () => sessions.get("own").movements,
      add(movements) {
        player.stop();
        if (movements.length > 0) show("own");
        return add(movements);
      },
      clear() {
        sessions.clear("own");
        show("simulated");
      },
      write: (text) => status.write(text),
    },
  );

  part("layouts").addEventListener("change", (event) => {
    player.stop();
    field.layout = (event.target as HTMLInputElement).value as Layout;
    if (shown === "simulated") showExample();
    status.write(`${count(field.targets.length, "target")}: ${TASK}.`);
    refresh();
  });
  new ResizeObserver(() => {
    if (!field.fit()) return;
    player.stop();
    refresh();
  }).observe(part("field"));

  showExample();
  const before = await kept().catch(() => []);
  if (before.length > 0) {
    sessions.add("own", before);
    show("own");
    status.write(`${count(before.length, "movement")} from before. For more, ${TASK}.`);
  } else status.write(`A simulated hand’s movements, until you ${TASK} yourself.`);
  await firstScored;
});

/** What the ten lines give of a movement, up to its entry. */
async function showExampleOf(movement: Movement): Promise<void> {
  const { rightAfter } = await import("./example.js");
  const samples = movement.samples.slice(0, approachOf(movement) ?? 0);
  const right = rightAfter({ ...movement, samples }).filter(Boolean).length;
  part("example-result").textContent =
    `They ran just now, on the last movement: right after ${right} of ${count(samples.length, "sample")} up to the entry.`;
}

const MISSED = {
  press: "Beside it: press the lit target.",
  lift: "Lifted beside it: drag the ring to the lit target and lift there.",
  tap: "A tap has no movement to predict from: drag the ring to the lit target and lift there.",
};
