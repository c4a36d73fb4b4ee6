import type { Movement } from "./movement.ts";

/** Whether the right target was on top after each sample. */
export function rightAfter(movement: Pick<Movement, "targets" | "target" | "samples">): boolean[];
