/** What is followed: one vessel, or a hundred. */
import type { Settings } from "./scenario.ts";

/** Seconds of the bay in one place of the playback. */
export const TICK = 5;

export interface Scene {
  /** The last place of its playback, and the one at which it is first shown. */
  readonly last: number;
  readonly firstLook: number;
  /** The time at a place, in words. */
  text(place: number): string;
  /** It is what is shown from now on. */
  enter(): void;
  set(settings: Settings): void;
  /** Draws what is the case now, and computes for as long as the deadline allows: true where nothing is left to do. */
  draw(deadline: number): boolean;
}
