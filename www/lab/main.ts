/** Puts the lab together: a field that records, workers that score and fit, what they show. */
import { begin, part, reasonOf } from "../shared/page.ts";
import { Status } from "../shared/status.ts";
import { theme } from "../shared/theme.ts";
import example from "./example.js?raw";
import { dataControls } from "./data.ts";
import { Field, type Layout } from "./field.ts";
import { Hand } from "./hand.ts";
import { keepMore, kept } from "./keep.ts";
import { Live } from "./live.ts";
import { approachOf, type Movement, type Sample } from "./movement.ts";
import { hasExpected } from "./recorder.ts";
import { Sessions, type SessionName } from "./sessions.ts";
import { Views } from "./views.ts";
import { count, recorded } from "./words.ts";

/** What there is to do, by the pointer that the visitor has. */
const TASK = matchMedia("(hover: none)").matches ? "drag the ring to the marked target" : "press the marked target";

const status = new Status(part("status"), part("announcement"));

begin(status, async () => {
  theme(part<HTMLButtonElement>("theme"), () => undefined);
  part("example").textContent = example;
  await document.fonts.ready;

  let shown: SessionName = "simulated";
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
        hand.stop();
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
        show("own");
        status.show(recorded(movement, null));
        add([movement]);
      },
      missed(by) {
        status.write(MISSED[by]);
      },
      moved: (samples) => predict(samples),
    },
  );

  /** What is predicted while a pointer moves, once that is loaded, and where it is wanted. */
  let live: Live | null = null;
  const wanted = part<HTMLInputElement>("live");
  function predict(samples: readonly Sample[]): void {
    const probabilities = samples.length > 0 && wanted.checked && live ? live.follow(samples) : null;
    field.light(probabilities);
    views.panel.now(probabilities, field.asked);
  }
  const aim = () => live?.setTargets(field.targets);
  wanted.addEventListener("change", () => predict([]));

  const views = new Views(
    status,
    (name) => {
      hand.stop();
      show(name);
    },
    () => refresh(),
  );

  const failed = (error: unknown) => status.write(`Something does not work here: ${reasonOf(error)}`, true);
  const sessions = new Sessions({
    changed(name) {
      const { movements, waiting } = sessions.get(name);
      views.panel.count(name, movements.length);
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
    views.draw(shown, session);
    field.drawPaths(session.movements, session.last);
    if (!session.last || session.last.movement.id !== fresh) return;
    fresh = null;
    status.write(recorded(session.last.movement, session.last.trace));
  }

  function show(name: SessionName): void {
    if (name === shown) return;
    shown = name;
    views.change();
    if (name === "simulated") hand.showExample();
    refresh();
  }

  /** To the visitor's own. */
  function add(movements: readonly Movement[]): readonly Movement[] {
    const added = sessions.add("own", movements);
    keepMore(added).catch(failed);
    return added;
  }

  const hand = new Hand(part<HTMLButtonElement>("hand"), field, {
    begins(words) {
      show("simulated");
      status.write(words);
    },
    moved: (samples) => predict(samples),
    made: (movements) => void sessions.add("simulated", movements),
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
        hand.stop();
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
    hand.stop();
    field.layout = (event.target as HTMLInputElement).value as Layout;
    aim();
    if (shown === "simulated") hand.showExample();
    status.write(`${count(field.targets.length, "target")}: ${TASK}.`);
    refresh();
  });
  new ResizeObserver(() => {
    if (!field.fit()) return;
    aim();
    hand.stop();
    refresh();
  }).observe(part("field"));

  hand.showExample();
  const before = await kept().catch(() => []);
  if (before.length > 0) {
    sessions.add("own", before);
    show("own");
    status.write(`${count(before.length, "movement")} from before. For more, ${TASK}.`);
  } else status.write(`A simulated hand’s movements, until you ${TASK} yourself.`);
  await firstScored;
  Live.begin().then((begun) => {
    live = begun;
    aim();
    document.documentElement.toggleAttribute("data-live", true);
  }, failed);
});

const MISSED = {
  press: "Beside it: press the marked target.",
  lift: "Lifted beside it: drag the ring to the marked target and lift there.",
  tap: "A tap has no movement to predict from: drag the ring to the marked target and lift there.",
};
