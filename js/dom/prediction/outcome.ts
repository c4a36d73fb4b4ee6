/**
 * How a press was predicted.
 *
 * @module
 */
import type { Learnt } from "../../core/learnt.js";
import type { Hand, Meant } from "../hand.js";
import type { Outcome } from "../ledger.js";
import { idOf, isGone, type Target } from "../targets.js";
import type { Movement } from "./movements.js";

/** A press with what came of the movement that led to it. */
export interface Press {
  readonly target: Target;
  readonly outcome: Outcome;
  /** The most probable target of each frame. */
  readonly leaders: readonly { readonly target: Target; readonly probability: number }[];
  /** The movement, if it is recorded. */
  readonly line: string | null;
}

/** A press on a target at a time, with its posterior probability before; with `active`, what could have been pressed, its movement is recorded. */
export function outcomeOf(
  { pointerType }: Hand,
  target: Target,
  movement: Movement,
  time: number,
  probability: number,
  learnt: Learnt | null,
  active: readonly Target[] | null,
): Press {
  const { node, settings } = target;
  const outcome: Outcome = {
    target: node,
    id: idOf(target),
    name: settings.name,
    data: settings.data,
    time,
    pointerType,
    ...judge(movement.meant, target, time),
    probability,
    learnt,
  };
  return { target, outcome, leaders: movement.leaders, line: active && lineOf(active, target, movement) };
}

/** Judges what was meant before a press on `pressed`: what is meant at the press comes too late. */
function judge(meant: readonly Meant[], pressed: Target, time: number): Pick<Outcome, "verdict" | "mistaken" | "lead"> {
  let mistaken: Target | null = null;
  let since: number | null = null;
  for (const each of meant) {
    if (each.time >= time) break;
    if (each.target === pressed) since ??= each.time;
    else {
      mistaken ??= each.target;
      since = null;
    }
  }
  const verdict = mistaken ? "wrong" : since !== null ? "right" : "unsure";
  return {
    verdict,
    mistaken: mistaken && !isGone(mistaken) ? mistaken.node : null,
    lead: since === null ? 0 : (time - since) / 1000,
  };
}

/** A line that `npm run evaluate` and `fit` read; null where the target could not have been pressed. */
function lineOf(active: readonly Target[], pressed: Target, { samples }: Movement): string | null {
  const target = active.indexOf(pressed);
  if (target < 0) return null;
  const targets = active.map(({ box }) => box && [box.x + box.width / 2, box.y + box.height / 2, box.width, box.height]);
  return JSON.stringify({ targets, target, samples: samples.map(({ time, x, y }) => [time, x, y]) });
}
