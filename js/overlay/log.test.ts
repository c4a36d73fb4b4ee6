import assert from "node:assert/strict";
import { describe, it } from "node:test";
import type { Outcome, Reason, Snapshot, Watcher, WatchTarget } from "#dom";
import { Log } from "./log.js";

const [a, b] = ["a", "b"].map((id) => ({ id })) as unknown as [WatchTarget, WatchTarget];

function logged() {
  const outcomes: Outcome[] = [];
  const watcher = { targets: [a, b], ledger: { outcomes }, probability: () => 0.9 } as unknown as Watcher;
  const log = new Log(watcher);
  return {
    log,
    intent: (target: WatchTarget, reason: Reason) => log.begin({ target, reason, probability: 0.8 } as never),
    release: (target: WatchTarget, pressed = false) => log.release({ target, pressed } as never),
    look: (...intended: WatchTarget[]) => log.look({ intended } as unknown as Snapshot, { reasonOf: () => "hover" } as never),
    outcome: (target: WatchTarget, verdict: Outcome["verdict"], lead: number) =>
      outcomes.push({ target, verdict, lead, time: 0, probability: 0.7 } as Outcome),
    outcomes,
  };
}

const short = ({ entries }: Log) =>
  entries.map(({ target, reason, end, verdict }) => [(target as { id: string }).id, reason, end, verdict]);

describe("the log of intents", () => {
  it("has what elements dispatch once, and not what other watchers have", () => {
    const { log, intent, release, look } = logged();
    intent(a, "pointer");
    look(a);
    intent({ id: "other" } as never, "pointer");
    assert.deepEqual(short(log), [["a", "pointer", null, null]]);
    release(a);
    look();
    assert.deepEqual(short(log), [["a", "pointer", "released", null]]);
    assert.equal(log.count, 1);
  });

  it("has the ledger's lead and verdict of a press, of one that nothing was meant before too", () => {
    const { log, intent, release, look, outcome } = logged();
    intent(a, "pointer");
    outcome(a, "right", 0.4);
    release(a, true);
    look();
    intent(b, "press");
    outcome(b, "wrong", 0);
    release(b, true);
    look();
    assert.deepEqual(short(log), [
      ["b", "press", "pressed", "wrong"],
      ["a", "pointer", "pressed", "right"],
    ]);
    assert.equal(log.entries[1]?.seconds, 0.4);
  });

  it("finds in snapshots and the ledger what dispatches nothing", () => {
    const { log, look, outcome } = logged();
    look(a);
    look(a, b);
    look(b);
    outcome(b, "right", 0.2);
    look();
    outcome(b, "unsure", 0);
    look();
    assert.deepEqual(short(log), [
      ["b", "press", "pressed", "unsure"],
      ["b", "hover", "pressed", "right"],
      ["a", "hover", "released", null],
    ]);
    assert.equal(log.entries[2]?.probability, 0.9);
  });

  it("is bounded, and goes on where the ledger's oldest outcomes go", () => {
    const { log, look, outcome, outcomes } = logged();
    for (let k = 0; k < 150; k++) {
      look(a);
      look();
    }
    assert.deepEqual([log.entries.length, log.count], [100, 150]);
    for (let k = 0; k < 5; k++) outcome(b, "right", 0.1);
    look();
    outcomes.splice(0, 5);
    outcome(b, "wrong", 0.1);
    look();
    assert.deepEqual(
      log.entries.slice(0, 7).map(({ verdict }) => verdict),
      ["wrong", "right", "right", "right", "right", "right", null],
    );
  });
});
