import assert from "node:assert/strict";
import { describe, it } from "node:test";
import { approachOf, places, readLines, writeLine, type Movement } from "./movement.ts";

const GOOD = '{"id":"a","user":"b","targets":[[0,0,2,2],[9,9,2,2]],"target":1,"samples":[[0,0,0],[0.5,4,5],[1,9,9]]}';

/** What is wrong with one line between good ones. */
function fault(line: string): string {
  const { movements, broken } = readLines(`${GOOD}\n\n${line}\n${GOOD}\n`);
  assert.equal(movements.length, 2, "the others are read");
  assert.deepEqual(
    broken.map((each) => each.line),
    [3],
  );
  return broken[0]?.message ?? "";
}

describe("lines", () => {
  it("come back as they were", () => {
    const { movements, broken } = readLines(`${GOOD}\r\n${GOOD}`);
    assert.deepEqual(broken, []);
    assert.deepEqual(movements.map(writeLine), [GOOD, GOOD]);
  });

  it("may have numbers for names, none at all, and coordinates that are missing", () => {
    const { movements } = readLines('{"id":3,"targets":[[0,0,2,2]],"target":0,"samples":[[0,9,null],[0.5,null,7],[1,0,0]]}');
    const [movement] = movements;
    assert.ok(movement);
    assert.deepEqual([movement.id, movement.user], ["3", ""]);
    assert.deepEqual(places(movement), [
      [9, 7],
      [9, 7],
      [0, 0],
    ]);
    assert.equal(approachOf(movement), 3);
  });

  it("that are broken are reported with their number, the field and the value", () => {
    assert.equal(fault("{"), "is no JSON: {");
    assert.equal(fault("[1]"), "must be an object, got [1]");
    assert.equal(
      fault(GOOD.replace("samples", "sample")),
      "sample: unknown key, expected one of id, user, targets, target, samples",
    );
    assert.equal(fault('{"targets":[[0,0,1,1]],"target":0}'), "samples: is missing");
    assert.equal(fault(GOOD.replace("[0.5,4,5]", '[0.5,"4",5]')), "samples[1][1]: must be a number, got 4");
    assert.equal(fault(GOOD.replace("[0.5,4,5]", "[2,4,5]")), "samples[2]: must not be before the sample at 2, got [1,9,9]");
    assert.equal(
      fault(GOOD.replace("[0.5,4,5]", "[0.5,4,5,6]")),
      "samples[1]: has 3 coordinates; the lab reads movements in the plane",
    );
    assert.equal(
      fault(GOOD.replace('"target":1', '"target":2')),
      "target: must be the place of one of the 2 targets, counted from 0, got 2",
    );
    assert.equal(fault(GOOD.replace("[9,9,2,2]", "[9,9,2]")), "targets[1]: must be [x, y, width, height], got [9,9,2]");
    assert.equal(
      fault(GOOD.replace("[9,9,2,2]", "[9,9,2,0]")),
      "targets[1]: must have a width and a height above 0, got [9,9,2,0]",
    );
    assert.equal(fault(GOOD.replace(/"samples".*/, '"samples":[]}')), "samples: must not be empty, got []");
  });
});

describe("the approach", () => {
  const along = (...xs: number[]): Movement => ({
    id: "",
    user: "",
    targets: [[10, 0, 4, 4]],
    target: 0,
    samples: xs.map((x, k) => [k, x, 0]),
  });

  it("goes to the last entry into the target", () => {
    assert.equal(approachOf(along(0, 5, 9, 11)), 3);
    assert.equal(approachOf(along(0, 9, 15, 11, 10)), 4);
  });

  it("is none where the target is never entered, or never left", () => {
    assert.equal(approachOf(along(0, 5, 7)), null);
    assert.equal(approachOf(along(9, 10, 11)), null);
  });
});
