/** The visitor's movements and the simulated hand's, apart, each scored as it grows. */
import { writeLine, type Movement } from "./movement.ts";
import type { Failed, Request, Scored } from "./score.worker.ts";
import type { Summary } from "./tally.ts";

export const SESSIONS = ["own", "simulated"] as const;
export type SessionName = (typeof SESSIONS)[number];

/** One of them. */
export interface Session {
  readonly movements: readonly Movement[];
  /** How those score that are done; null before any is. */
  readonly summary: Summary | null;
  /** The last movement that was scored, with its trace. */
  readonly last: Scored["last"];
  /** Movements that are still to be scored. */
  readonly waiting: number;
}

const EMPTY: Session = { movements: [], summary: null, last: null, waiting: 0 };

export interface SessionsEvents {
  /** After every change of a session, and when more of it has been scored. */
  changed(name: SessionName): void;
  /** Something could not be scored, in words. */
  refused(words: string): void;
  failed(error: Error): void;
}

export class Sessions {
  readonly #worker = new Worker(new URL("./score.worker.ts", import.meta.url), { type: "module" });
  readonly #events: SessionsEvents;
  readonly #sessions: Record<SessionName, Session> = { own: EMPTY, simulated: EMPTY };
  /** The lines of each, so that none is there twice. */
  readonly #lines: Record<SessionName, Set<string>> = { own: new Set(), simulated: new Set() };
  /** How often each was emptied: reports from before are not of it. */
  readonly #emptied: Record<SessionName, number> = { own: 0, simulated: 0 };

  constructor(events: SessionsEvents) {
    this.#events = events;
    this.#worker.addEventListener("message", ({ data }: MessageEvent<Scored | Failed>) => {
      if ("failed" in data) {
        events.failed(new Error(data.failed));
        return;
      }
      const name = SESSIONS.find((each) => this.#key(each) === data.session);
      if (!name) return;
      const { movements, last } = this.#sessions[name];
      const waiting = movements.length - data.done;
      this.#sessions[name] = { movements, summary: data.summary, last: data.last ?? last, waiting };
      if (data.refused) events.refused(data.refused);
      events.changed(name);
    });
    this.#worker.addEventListener("error", ({ message }) => events.failed(new Error(message || "the worker does not load")));
  }

  get(name: SessionName): Session {
    return this.#sessions[name];
  }

  /** Those that are not there already, by all that a line holds; returns them. */
  add(name: SessionName, movements: readonly Movement[]): readonly Movement[] {
    const session = this.#sessions[name];
    const known = this.#lines[name];
    const added = movements.filter((movement) => {
      const line = writeLine(movement);
      return !known.has(line) && known.add(line);
    });
    if (added.length === 0) return added;
    this.#sessions[name] = {
      ...session,
      movements: [...session.movements, ...added],
      waiting: session.waiting + added.length,
    };
    this.#post({ kind: "add", session: this.#key(name), movements: added });
    this.#events.changed(name);
    return added;
  }

  clear(name: SessionName): void {
    this.#post({ kind: "clear", session: this.#key(name) });
    this.#emptied[name] += 1;
    this.#lines[name].clear();
    this.#sessions[name] = EMPTY;
    this.#events.changed(name);
  }

  #key(name: SessionName): string {
    return `${name} ${this.#emptied[name]}`;
  }

  #post(request: Request): void {
    this.#worker.postMessage(request);
  }
}
