/** Scores gestures, one after the other, off the page's own thread. */
import { init } from "whither";
import type { Road } from "../road.ts";
import { type Score, Scorer } from "./score.ts";

export interface Order {
  readonly seed: number;
  readonly count: number;
  readonly road: Road;
}

/** The scores of the next gesture, or what went wrong. */
export type Answer = { readonly scores: readonly Score[] } | { readonly error: string };

addEventListener("message", ({ data }: MessageEvent<Order>) => {
  run(data).catch((error: unknown) => answer({ error: error instanceof Error ? error.message : String(error) }));
});

async function run({ seed, count, road }: Order): Promise<void> {
  await init();
  const scorer = new Scorer(road);
  for (let k = 0; k < count; k += 1) answer({ scores: scorer.score(seed * 1000 + k) });
}

function answer(message: Answer): void {
  postMessage(message);
}
