/** What is shown of a session: the panel, the table, the pictures, what can be learnt from it, the ten lines at work. */
import { part, reasonOf } from "../shared/page.ts";
import type { Status } from "../shared/status.ts";
import { Fitting } from "./fitting.ts";
import { approachOf, type Movement } from "./movement.ts";
import { Panel } from "./panel.ts";
import { Pictures } from "./pictures.ts";
import type { Session, SessionName } from "./sessions.ts";
import { Table } from "./table.ts";
import { count, leading } from "./words.ts";

export class Views {
  readonly panel: Panel;
  readonly #table: Table;
  readonly #pictures: Pictures;
  readonly #fitting: Fitting;
  readonly #status: Status;
  #ran: Movement | null = null;

  /** `chosen` is called with the session that the visitor wants to look at, `stale` where all has to be drawn again. */
  constructor(status: Status, chosen: (name: SessionName) => void, stale: () => void) {
    this.#status = status;
    this.panel = new Panel(
      {
        facts: part("facts"),
        own: part<HTMLInputElement>("session-own"),
        simulated: part<HTMLInputElement>("session-simulated"),
        ownCount: part("own-count"),
        simulatedCount: part("simulated-count"),
        progress: part<HTMLProgressElement>("scoring"),
      },
      chosen,
    );
    this.#table = new Table(part<HTMLTableElement>("methods"), stale);
    this.#pictures = new Pictures({
      movement: part<SVGSVGElement>("movement"),
      course: part<SVGSVGElement>("course"),
      calibration: part<SVGSVGElement>("calibration"),
      movementWords: part("movement-words"),
      courseWords: part("course-words"),
      calibrationWords: part("calibration-words"),
    });
    this.#fitting = new Fitting(
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
  }

  draw(name: SessionName, session: Session): void {
    const { movements, summary, last, waiting } = session;
    this.panel.show(name, session);
    this.#table.show(summary, last, name === "own");
    this.#pictures.draw(summary, last, this.#table.shown);
    this.#fitting.show(movements);
    part("leading").textContent = leading(summary?.comparison ?? null, summary?.rows ?? []);
    part<HTMLButtonElement>("export").disabled = movements.length === 0;
    document.documentElement.toggleAttribute("data-scoring", waiting > 0);
    if (last) this.#runExample(last.movement);
  }

  /** Another session is drawn next. */
  change(): void {
    this.#fitting.clear();
  }

  #runExample(movement: Movement): void {
    if (movement === this.#ran) return;
    this.#ran = movement;
    runExample(movement).then(
      (words) => (part("example-result").textContent = words),
      (error) => this.#status.write(`The ten lines do not run: ${reasonOf(error)}`),
    );
  }
}

/** What the ten lines give of a movement, up to its entry. */
async function runExample(movement: Movement): Promise<string> {
  const { rightAfter } = await import("./example.js");
  const samples = movement.samples.slice(0, approachOf(movement) ?? 0);
  const right = rightAfter({ ...movement, samples }).filter(Boolean).length;
  return `They ran just now, on the last movement: right after ${right} of ${count(samples.length, "sample")} up to the entry.`;
}
