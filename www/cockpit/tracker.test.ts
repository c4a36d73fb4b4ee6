import assert from "node:assert/strict";
import { describe, it } from "node:test";
import { HandMovements, type Position, type Sample, screenFrame, tipOfJoint, tipOfLandmarks } from "./tracker.ts";

const PICTURE = { width: 1280, height: 720, fieldOfView: 70 };
const FOCAL = 640 / Math.tan((35 * Math.PI) / 180);

/** A hand of 21 landmarks about its middle, in metres: a wrist and five fingers that are spread. */
const HAND = Array.from({ length: 21 }, (_, k) => {
  const [finger, joint] = [Math.floor((k - 1) / 4), ((k - 1) % 4) + 1];
  return k === 0
    ? { x: 0, y: 0.09, z: 0.01 }
    : { x: 0.022 * (finger - 2), y: 0.05 - 0.035 * joint, z: -0.004 * joint - 0.006 * finger };
});

/** What a camera finds of the hand when its middle is there, in metres. */
function found(x: number, y: number, z: number) {
  const landmarks = HAND.map((point) => ({
    x: 0.5 + (FOCAL * (point.x + x)) / (point.z + z) / PICTURE.width,
    y: 0.5 + (FOCAL * (point.y + y)) / (point.z + z) / PICTURE.height,
    z: 0,
  }));
  return { landmarks: [landmarks], worldLandmarks: [HAND] };
}

function close(actual: readonly number[] | null, expected: readonly number[], tolerance: number): void {
  assert.ok(actual && actual.length === expected.length, String(actual));
  actual.forEach((x, k) => assert.ok(Math.abs(x - (expected[k] ?? NaN)) <= tolerance, `${actual} for ${expected}`));
}

describe("MediaPipe's landmarks", () => {
  it("give the fingertip in the camera's frame", () => {
    const tip = HAND[8] ?? { x: 0, y: 0, z: 0 };
    for (const [x, y, z] of [
      [0, 0, 0.4],
      [0.2, -0.1, 0.6],
      [-0.15, 0.12, 0.9],
    ] as const) {
      close(tipOfLandmarks(found(x, y, z), PICTURE), [tip.x + x, tip.y + y, tip.z + z], 1e-12);
    }
  });

  it("are of the hand that is asked for, and nothing without one", () => {
    const [near, far] = [found(0, 0, 0.4), found(0, 0, 0.8)];
    const both = {
      landmarks: [...near.landmarks, ...far.landmarks],
      worldLandmarks: [...near.worldLandmarks, ...far.worldLandmarks],
    };
    assert.deepEqual(tipOfLandmarks(both, PICTURE, 1), tipOfLandmarks(far, PICTURE));
    assert.equal(tipOfLandmarks(near, PICTURE, 1), null);
    assert.equal(tipOfLandmarks({ landmarks: [], worldLandmarks: [] }, PICTURE), null);
    assert.throws(() => tipOfLandmarks(near, { ...PICTURE, fieldOfView: 180 }), {
      name: "WhitherError",
      code: "out-of-range",
      path: "picture.fieldOfView",
      message: "picture.fieldOfView: must be between 0 and 180 degrees, got 180",
    });
  });

  it("are placed on the screen by three presses, whatever the field of view was taken for", () => {
    const size = { width: 280, height: 120 };
    for (const [fieldOfView, distance] of [
      [60, 242.3],
      [70, 200],
      [80, 166.9],
    ] as const) {
      const pressed = (x: number, y: number) => tipOfLandmarks(found(x, y, 0.7), { ...PICTURE, fieldOfView }) as Position;
      const place = screenFrame([pressed(-0.14, -0.06), pressed(0.14, -0.06), pressed(-0.14, 0.06)], size);
      // right on the screen; in front of it as well as the field of view is known
      close(place(pressed(0.06, 0.02)), [200, 80, 0], 1);
      const [x, y, z] = place(tipOfLandmarks(found(0, 0, 0.5), { ...PICTURE, fieldOfView }) as Position);
      close([x, y], [140, 60], 8);
      close([z], [distance], 0.1);
    }
  });
});

describe("WebXR's joints", () => {
  it("are positions in metres, or none", () => {
    assert.deepEqual(tipOfJoint({ transform: { position: { x: 0.1, y: 1.2, z: -0.4 } } }), [0.1, 1.2, -0.4]);
    assert.equal(tipOfJoint(null), null);
    assert.equal(tipOfJoint(undefined), null);
  });
});

describe("the screen's frame", () => {
  const size = { width: 240, height: 140 };
  // leans back, in metres, y up and z towards the user
  const corners = [
    [-0.12, 1.33, -0.08],
    [0.12, 1.33, -0.08],
    [-0.12, 1.199, -0.031],
  ] as const;

  it("has x to the right, y downwards, z towards the user, in mm", () => {
    const place = screenFrame(corners, size);
    close(place(corners[0]), [0, 0, 0], 1e-9);
    close(place(corners[1]), [240, 0, 0], 1e-9);
    close(place(corners[2]), [0, 140, 0], 1e-9);
    const [x, y, z] = place([0, 1.35, 0.2]);
    assert.ok(Math.abs(x - 120) < 1e-9 && y < 100 && z > 200, `${[x, y, z]}`);
  });

  it("is refused where the corners are none of a rectangle", () => {
    const refused = (third: Position, message: string) =>
      assert.throws(() => screenFrame([corners[0], corners[1], third], size), {
        name: "WhitherError",
        code: "out-of-range",
        path: "corners",
        message,
      });
    refused([0.3, 1.32, -0.08], "corners: must have a right angle at the first one, got 1 degrees");
    refused(corners[0], "corners: must have a right angle at the first one, got none");
    refused([NaN, 0, 0], "corners: must have a right angle at the first one, got none");
    const error = {
      name: "WhitherError",
      code: "out-of-range",
      path: "size",
      message: "size: must be greater than 0, got 240 by 0",
    };
    assert.throws(() => screenFrame(corners, { width: 240, height: 0 }), error);
  });
});

describe("movements", () => {
  /** Frames of time in ms and distance from the screen, null without a hand; gives what is called back. */
  function replayed(frames: readonly (readonly [number, number | null])[]): (Sample | string)[] {
    const calls: (Sample | string)[] = [];
    const movements = new HandMovements((tip) => tip, {
      sample: (sample) => calls.push(sample),
      end: (reason) => calls.push(reason),
    });
    for (const [time, z] of frames) movements.frame(time, z === null ? null : [10, 20, z]);
    return calls;
  }

  it("have samples in seconds, and end with the touch", () => {
    assert.deepEqual(
      replayed([
        [1000, 90],
        [1020, 40],
        [1040, 4],
      ]),
      [[1, 10, 20, 90], [1.02, 10, 20, 40], [1.04, 10, 20, 4], "touch"],
    );
  });

  it("begin again when the hand is off the screen", () => {
    const calls = replayed([
      [0, 2],
      [20, 8],
      [40, 29],
      [60, 31],
      [80, 50],
    ]);
    assert.deepEqual(calls, [[0, 10, 20, 2], "touch", [0.06, 10, 20, 31], [0.08, 10, 20, 50]]);
  });

  it("go on over frames without a hand, and end when it is lost", () => {
    assert.deepEqual(
      replayed([
        [0, 90],
        [100, null],
        [480, null],
        [500, 60],
      ]),
      [
        [0, 10, 20, 90],
        [0.5, 10, 20, 60],
      ],
    );
    assert.deepEqual(
      replayed([
        [0, 90],
        [400, null],
        [510, null],
        [600, null],
      ]),
      [[0, 10, 20, 90], "lost"],
    );
    // a tracker that reports nothing while there is no hand
    assert.deepEqual(
      replayed([
        [0, 90],
        [700, 60],
      ]),
      [[0, 10, 20, 90], "lost", [0.7, 10, 20, 60]],
    );
  });

  it("count a frame that comes twice once", () => {
    assert.deepEqual(
      replayed([
        [0, 90],
        [0, 90],
        [20, 80],
        [10, 85],
      ]),
      [
        [0, 10, 20, 90],
        [0.02, 10, 20, 80],
      ],
    );
  });
});
