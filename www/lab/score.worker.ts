/** Scores movements in a thread of its own: a pointer is followed without a pause meanwhile. */
import { init } from "whither";
import { reasonOf } from "../shared/page.ts";
import type { Movement } from "./movement.ts";
import { predict } from "./predictions.ts";
import { Tally, type Summary, type Trace } from "./tally.ts";

/** To the worker: more movements of a session, or that it begins anew. */
export type Request =
  | { readonly kind: "add"; readonly session: string; readonly movements: readonly Movement[] }
  | { readonly kind: "clear"; readonly session: string };

/** From the worker, where the core cannot start: nothing is scored. */
export interface Failed {
  readonly failed: string;
}

/** From the worker: how far a session is. */
export interface Scored {
  readonly session: string;
  readonly summary: Summary;
  /** How many of its movements are done, with those that never enter their target. */
  readonly done: number;
  /** The last movement that was scored, and its trace; null while others wait. */
  readonly last: { readonly movement: Movement; readonly trace: Trace } | null;
  /** What a predictor did not take, in words; null almost always. */
  readonly refused: string | null;
}

/** Milliseconds between two reports. */
const PACE = 120;

const ready = init();
const tallies = new Map<string, { readonly tally: Tally; done: number }>();
let queue: { session: string; movement: Movement }[] = [];
let working = false;

addEventListener("message", ({ data }: MessageEvent<Request>) => {
  if (data.kind === "clear") {
    queue = queue.filter(({ session }) => session !== data.session);
    tallies.delete(data.session);
  } else {
    queue.push(...data.movements.map((movement) => ({ session: data.session, movement })));
    if (!working) void work();
  }
});

async function work(): Promise<void> {
  working = true;
  try {
    await ready;
    let reported = performance.now();
    for (let next = queue.shift(); next; next = queue.shift()) {
      const { session, movement } = next;
      const state = tallies.get(session) ?? { tally: new Tally(predict), done: 0 };
      tallies.set(session, state);
      let refused: string | null = null;
      try {
        state.tally.add(movement);
      } catch (error) {
        refused = `The movement ${movement.id} cannot be scored: ${reasonOf(error)}`;
      }
      state.done += 1;
      const isLast = queue.every((other) => other.session !== session);
      if (isLast || refused || performance.now() - reported > PACE) {
        reported = performance.now();
        const last = isLast && !refused ? { movement, trace: state.tally.trace(movement) } : null;
        postMessage({ session, summary: state.tally.summary(), done: state.done, last, refused } satisfies Scored);
      }
      // what has come meanwhile, such as that it begins anew
      await new Promise((resolve) => setTimeout(resolve));
    }
  } catch (error) {
    postMessage({ failed: reasonOf(error) } satisfies Failed);
  } finally {
    working = false;
  }
}
