/**
 * What a watcher gives to tools that ask the page for its watchers.
 *
 * @module
 */
import type { Inspection, Reason, TargetOptions, WatchTarget } from "../types.js";
import type { Parts } from "./prediction.js";
import type { Track } from "./track.js";

/** The type of the event by which a tool asks. */
export const INSPECT = "whither:inspect";

/** Answers by calling the event's `detail`; what that throws is reported. */
export function answering(inspection: Inspection, failed: (error: unknown) => void): (event: CustomEvent) => void {
  return ({ detail }) => {
    try {
      if (typeof detail === "function") detail(inspection);
    } catch (error) {
      failed(error);
    }
  };
}

/** Reads when it is read: it holds as long as the watcher. */
export function inspectionOf({ watcher, settings, targets }: Parts, tracks: () => Iterable<Track>): Inspection {
  return {
    watcher,
    get options() {
      const { threshold, release, none } = settings();
      return { threshold, release, none };
    },
    optionsOf(node: WatchTarget): TargetOptions {
      const { hitSlop, ...own } = targets.find(node)?.settings ?? {};
      if (!hitSlop) return own;
      const [top, right, bottom, left] = hitSlop;
      return { ...own, hitSlop: { top, right, bottom, left } };
    },
    reasonOf(node: WatchTarget): Reason | null {
      const meant = [...tracks()].flatMap(({ movement }) => movement?.meant ?? []);
      const [last] = meant.filter(({ target }) => target.node === node).sort((a, b) => b.time - a.time);
      return last?.reason ?? null;
    },
  };
}
