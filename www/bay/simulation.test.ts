import assert from "node:assert/strict";
import { before, describe, it } from "node:test";
import { init } from "whither";
import { BASIN, distance, HARBOURS } from "./coast.ts";
import { depth } from "./depth.ts";
import { fleet, FLEET_INTERVAL, FLEET_SIZE, type Vessel } from "./fleet.ts";
import { HarbourMaster, LISTED } from "./harbour-master.ts";
import { Pursuit } from "./pursuit.ts";
import { Random } from "./random.ts";
import { bound, INTERVAL, placeAt, sail } from "./sail.ts";
import { DEFAULT } from "./scenario.ts";
import { voyages } from "./voyages.ts";

before(() => init());

describe("random numbers", () => {
  it("are the same for the same seed, and spread as they should be", () => {
    const draw = (seed: number) => {
      const random = new Random(seed);
      return Array.from({ length: 4000 }, () => random.normal());
    };
    const one = draw(3);
    assert.deepEqual(draw(3), one);
    assert.notDeepEqual(draw(4), one);
    const mean = one.reduce((sum, x) => sum + x, 0) / one.length;
    const variance = one.reduce((sum, x) => sum + x * x, 0) / one.length;
    assert.ok(Math.abs(mean) < 0.05 && Math.abs(variance - 1) < 0.08, `${mean}, ${variance}`);
  });
});

describe("a simulated voyage", () => {
  it("goes where its pins are, at its interval, the same for the same seed", () => {
    const [saltby] = HARBOURS.filter(({ id }) => id === "saltby");
    assert.ok(saltby);
    const track = (seed: number) =>
      sail(bound({ x: 0, y: 0 }, saltby, 6000, new Random(seed)), { seed, departs: 100, interval: 60 });
    const reports = track(1);
    assert.deepEqual(track(1), reports);
    assert.notDeepEqual(track(2), reports);
    assert.equal(reports.length, 101);
    assert.deepEqual([reports[0]?.time, reports[1]?.time, reports.at(-1)?.time], [100, 160, 6100]);
    assert.ok(distance(reports[0] ?? saltby, { x: 0, y: 0 }) < 60);
    assert.ok(distance(reports.at(-1) ?? { x: 0, y: 0 }, saltby) < 1500);
  });

  it("is between two reports on the line between them", () => {
    const reports = [
      { time: 0, x: 0, y: 0 },
      { time: 10, x: 100, y: 50 },
    ];
    assert.deepEqual(placeAt(reports, 4), { x: 40, y: 20 });
    assert.equal(placeAt(reports, -5).x, 0);
    assert.equal(placeAt(reports, 50).x, 100);
  });
});

describe("the named voyages", () => {
  it("stay in the water and end where they are meant to", () => {
    const all = voyages();
    assert.equal(new Set(all.map(({ id }) => id)).size, all.length);
    for (const { name, harbour, reports } of all) {
      assert.ok(
        reports.every((report) => depth(report) > 0),
        `${name} runs aground`,
      );
      assert.equal((reports[1]?.time ?? 0) - (reports[0]?.time ?? 0), INTERVAL);
      const end = reports.at(-1) ?? { x: 0, y: 0 };
      if (harbour) assert.ok(distance(end, harbour) < BASIN, name);
      else for (const one of HARBOURS) assert.ok(distance(end, one) > 10_000, `${name} ends near ${one.name}`);
    }
  });
});

describe("the fleet", () => {
  let vessels: Vessel[];
  before(() => (vessels = fleet()));

  it("is a hundred vessels with names of their own, six of which call nowhere, the same every day", () => {
    assert.equal(vessels.length, FLEET_SIZE);
    assert.equal(new Set(vessels.map(({ name }) => name)).size, FLEET_SIZE);
    assert.equal(vessels.filter(({ harbour }) => !harbour).length, 6);
    assert.deepEqual(fleet().at(-1), vessels.at(-1));
  });

  it("uses every harbour and stays in the water", () => {
    for (const harbour of HARBOURS) assert.ok(vessels.filter((vessel) => vessel.harbour === harbour).length >= 5, harbour.name);
    for (const { name, harbour, reports } of vessels) {
      const aground = reports.filter((report) => depth(report) <= 0 && !(harbour && distance(report, harbour) < 2 * BASIN));
      assert.equal(aground.length, 0, name);
      assert.equal((reports[1]?.time ?? 0) - (reports[0]?.time ?? 0), FLEET_INTERVAL);
    }
  });
});

describe("the harbour master", () => {
  it("has every report once, whatever the deadline, and is the same after going back", () => {
    const [patient, hurried] = [new HarbourMaster(), new HarbourMaster()];
    const time = patient.begins + 1200;
    assert.equal(patient.seek(time, Infinity), true);
    let turns = 0;
    while (!hurried.seek(time, 0)) turns += 1;
    assert.ok(turns > 500, `${turns} turns`);
    const state = (master: HarbourMaster) =>
      master.vessels.map(({ lookout }) => [
        lookout.moments.length,
        lookout.latest?.none,
        ...(lookout.latest?.probabilities ?? []),
      ]);
    assert.deepEqual(state(hurried), state(patient));
    patient.expect(Infinity);
    const board = patient.board().map((lines) => lines.map(({ vessel, median }) => [vessel.name, median]));
    patient.seek(time + 600, Infinity);
    patient.seek(time, Infinity);
    patient.expect(Infinity);
    assert.deepEqual(state(patient), state(hurried));
    assert.deepEqual(
      patient.board().map((lines) => lines.map(({ vessel, median }) => [vessel.name, median])),
      board,
    );
    patient.free();
    hurried.free();
  });

  it("lists who is more likely than not at a harbour, earliest first, and expects as many as their probabilities sum to", () => {
    const master = new HarbourMaster();
    master.seek(master.begins + 1800, Infinity);
    assert.equal(master.board().flat().length, 0);
    while (!master.expect(0));
    for (const [harbour, lines] of master.board().entries()) {
      for (const [rank, { vessel, probability, median, low, high }] of lines.entries()) {
        assert.ok(probability >= LISTED && low < median && median < high);
        assert.equal(vessel.lookout.latest?.best, harbour);
        assert.ok(median >= (lines[rank - 1]?.median ?? 0));
      }
    }
    const due = master.due().reduce((sum, one) => sum + one, 0);
    const none = master.vessels.reduce((sum, { lookout, arrived }) => sum + (arrived ? 0 : (lookout.latest?.none ?? 0)), 0);
    assert.ok(Math.abs(due + none - master.books().reporting) < 1e-6, `${due} and ${none}`);
    master.free();
  });
});

describe("a pursuit", () => {
  it("predicts the same whether it comes forwards or back, and forgets what was to come where it is taken over", () => {
    const [voyage] = voyages();
    assert.ok(voyage);
    const pursuit = new Pursuit(voyage.reports, DEFAULT);
    const time = pursuit.begins + 3000;
    pursuit.seek(time, Infinity);
    const { latest } = pursuit.lookout;
    const arrival = pursuit.lookout.arrivalAt(latest?.best ?? 0);
    pursuit.seek(pursuit.lasts, Infinity);
    pursuit.seek(time, Infinity);
    assert.deepEqual(pursuit.lookout.latest, latest);
    assert.deepEqual(pursuit.lookout.arrivalAt(latest?.best ?? 0), arrival);
    pursuit.take(time);
    assert.equal(pursuit.lasts, time);
    pursuit.add({ time: time + INTERVAL, x: 0, y: 0 });
    assert.equal(pursuit.seek(pursuit.lasts, Infinity), true);
    assert.equal(pursuit.lookout.latest?.report.time, time + INTERVAL);
    pursuit.lookout.free();
  });

  it("goes on after the last arrival time has passed: followed anew", () => {
    const pursuit = new Pursuit([{ time: 0, x: 0, y: 0 }], DEFAULT);
    for (let time = 600; time <= 16_200; time += 600) pursuit.add({ time, x: 0, y: time / 2 });
    pursuit.seek(16_200, Infinity);
    const { latest } = pursuit.lookout;
    const sum = [...(latest?.probabilities ?? [])].reduce((total, share) => total + share, latest?.none ?? 0);
    assert.ok(Math.abs(sum - 1) < 1e-9);
    assert.ok((pursuit.lookout.arrivalAt(latest?.best ?? 0)?.median ?? 0) > 16_200);
    pursuit.lookout.free();
  });
});
