import assert from "node:assert/strict";
import { describe, it } from "node:test";
import { BASIN, distance, EXTENT, harbourAt, HARBOURS, PILOT_STATION } from "./coast.ts";
import { below, sample } from "./contours.ts";
import { depth } from "./depth.ts";
import { Projection } from "./projection.ts";

describe("the coast", () => {
  it("has its harbours in the water, near land, 35 to 40 km from the pilot station", () => {
    for (const harbour of HARBOURS) {
      assert.ok(depth(harbour) > 0, harbour.name);
      const around = Array.from({ length: 16 }, (_, i) => (i * Math.PI) / 8);
      const ashore = around.map((angle) =>
        depth({ x: harbour.x + 3500 * Math.cos(angle), y: harbour.y + 3500 * Math.sin(angle) }),
      );
      assert.ok(Math.min(...ashore) < 0, `${harbour.name} is far from land`);
      const away = distance(harbour, PILOT_STATION);
      assert.ok(away > 35_000 && away < 40_000, `${harbour.name}: ${away} m`);
    }
  });

  it("leaves the straight way from the pilot station to each of them free", () => {
    for (const { name, x, y } of HARBOURS) {
      for (let share = 0; share <= 1; share += 0.01) assert.ok(depth({ x: share * x, y: share * y }) > 0, `${name} at ${share}`);
    }
  });

  it("is land in the north and deep water in the south, and an island is land", () => {
    assert.ok(depth({ x: 0, y: 44_000 }) < 0);
    assert.ok(depth({ x: 0, y: -5000 }) > 50);
    assert.ok(depth({ x: -39_000, y: -2800 }) < 0);
  });

  it("has banks: shallower than around them", () => {
    assert.ok(depth({ x: 17_000, y: 5500 }) < depth({ x: 10_000, y: 5500 }) - 10);
  });

  it("has basins that do not touch", () => {
    for (const harbour of HARBOURS) {
      assert.equal(harbourAt({ x: harbour.x + 0.9 * BASIN, y: harbour.y }), harbour);
      assert.equal(harbourAt({ x: harbour.x + 1.1 * BASIN, y: harbour.y }), null);
    }
  });
});

describe("contours", () => {
  const extent = { west: -2, east: 2, south: -2, north: 2 };
  const area = (ring: readonly { x: number; y: number }[]) =>
    ring.reduce((sum, { x, y }, i) => {
      const next = ring[(i + 1) % ring.length] ?? { x, y };
      return sum + (x * next.y - next.x * y) / 2;
    }, 0);

  it("go round what is below a level, once", () => {
    const rings = below(
      sample(({ x, y }) => Math.hypot(x, y), extent, 0.1),
      1,
    );
    assert.equal(rings.length, 1);
    assert.ok(Math.abs(Math.abs(area(rings[0] ?? [])) - Math.PI) < 0.02);
  });

  it("go the other way round a hole", () => {
    const rings = below(
      sample(({ x, y }) => Math.abs(Math.hypot(x, y) - 1), extent, 0.05),
      0.5,
    );
    assert.equal(rings.length, 2);
    const [one, other] = rings.map(area) as [number, number];
    assert.ok(one * other < 0);
    assert.ok(Math.abs(Math.abs(one + other) - Math.PI * (1.5 ** 2 - 0.5 ** 2)) < 0.02);
  });

  it("close at the grid's edge", () => {
    const [ring = [], ...more] = below(
      sample(({ x }) => x, extent, 0.5),
      0.25,
    );
    assert.equal(more.length, 0);
    assert.ok(Math.abs(area(ring)) > 8 && Math.abs(area(ring)) < 12);
  });

  it("find nothing where nothing is below", () =>
    assert.deepEqual(
      below(
        sample(() => 1, extent, 0.5),
        0,
      ),
      [],
    ));
});

describe("the projection", () => {
  for (const [width, height] of [
    [785, 505],
    [358, 358],
    [300, 600],
  ] as const) {
    it(`shows all of the extent on ${width} by ${height} px, at one scale, and is its own inverse`, () => {
      const projection = new Projection(width, height);
      for (const x of [EXTENT.west, EXTENT.east]) {
        for (const y of [EXTENT.south, EXTENT.north]) {
          const point = projection.toScreen({ x, y });
          assert.ok(point.x >= -1e-6 && point.x <= width + 1e-6 && point.y >= -1e-6 && point.y <= height + 1e-6);
          const back = projection.toPlace(point);
          assert.ok(Math.hypot(back.x - x, back.y - y) < 1e-6);
        }
      }
      const [a, b, c] = [
        { x: 0, y: 0 },
        { x: 1000, y: 0 },
        { x: 0, y: 1000 },
      ].map((place) => projection.toScreen(place));
      assert.ok(a && b && c && Math.abs(b.x - a.x - (a.y - c.y)) < 1e-9 && b.x > a.x && c.y < a.y);
    });
  }
});
