import type { Best, HandTarget, Remaining } from "whither";
import type { Sample } from "./gesture.ts";

/** The most probable icon at the last sample, and the time to go where it is known. */
export function whereTo(icons: readonly HandTarget[], samples: readonly Sample[]): Best & Partial<Remaining>;
