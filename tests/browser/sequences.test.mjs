// The page of the conditionally Markov sequences.
import assert from "node:assert/strict";
import { readFile } from "node:fs/promises";
import { after, before, describe, it } from "node:test";
import { isReady, launch, open, serve } from "./support.mjs";

const SEQUENCES = "sequences/index.html";

/** The facts, after the next frame. */
function facts(page) {
  return page.evaluate(async () => {
    await new Promise((resolve) => requestAnimationFrame(() => requestAnimationFrame(resolve)));
    const text = (id) => document.querySelector(`#${id}`).textContent;
    return Object.fromEntries(
      ["so-far", "deviation", "markov-deviation", "error", "markov-error", "kind", "given", "status"].map((id) => [id, text(id)]),
    );
  });
}

/** What the canvas shows, as a picture in text: another one for any other drawing. */
function drawing(page) {
  return page.evaluate(() => document.querySelector("#canvas").toDataURL());
}

/** The share of the canvas that is drawn on. */
function inked(page) {
  return page.evaluate(() => {
    const canvas = document.querySelector("#canvas");
    const { data } = canvas.getContext("2d").getImageData(0, 0, canvas.width, canvas.height);
    return data.filter((value, i) => i % 4 === 3 && value > 0).length / (data.length / 4);
  });
}

function metres(text) {
  const [number, unit] = text.split(" ");
  return Number(number) * (unit === "km" ? 1000 : 1);
}

describe("the page of the sequences", () => {
  let browser;
  let server;
  before(async () => {
    [browser, server] = await Promise.all([launch(), serve()]);
  });
  after(() => Promise.all([browser.close(), server.close()]));
  const opened = (options) => open(browser, server.url, options, SEQUENCES);

  it("shows the paper's figure and what is predicted after nine measurements", async () => {
    const { page, problems, close } = await opened();
    const share = await inked(page);
    assert.ok(share > 0.02, `${share} of the map is drawn on`);
    const found = await facts(page);
    assert.equal(found["so-far"], "9 of 100");
    assert.equal(found.deviation, "32 m"); // the paper's C_N: nine measurements hold no information on 30 m in 128 km
    assert.ok(metres(found["markov-deviation"]) > 1000, found["markov-deviation"]);
    assert.equal(found.kind, "reciprocal, not Markov");
    assert.match(found.given, /The first is also given where it will land, to 32 m\.$/);
    assert.match(found.status, /^After 9 measurements the landing place is known to 32 m; /);
    assert.equal(await page.locator("#announcement").textContent(), found.status);
    assert.deepEqual(problems, []);
    await close();
  });

  it("takes a waypoint from the mouse and from the keyboard, and gives it back", async () => {
    const { page, problems, close } = await opened();
    const before = await drawing(page);
    const { x, y, width, height } = await page.locator("#waypoint").boundingBox();
    await page.mouse.move(x + width / 2, y + height / 2);
    await page.mouse.down();
    await page.mouse.move(x + width / 2 + 40, y + height / 2 + 30, { steps: 4 });
    await page.mouse.up();
    assert.equal((await facts(page)).kind, "not reciprocal");
    const dragged = await drawing(page);
    assert.ok(dragged !== before);
    const label = await page.locator("#waypoint").getAttribute("aria-label");
    assert.match(label, /^Waypoint at \d+ km east, \d+ km north$/);
    await page.locator("#waypoint").press("ArrowRight");
    await facts(page);
    assert.notEqual(await page.locator("#waypoint").getAttribute("aria-label"), label);
    await page.locator("#remove").click();
    assert.equal((await facts(page)).kind, "reciprocal, not Markov");
    assert.ok((await drawing(page)) === before);
    assert.deepEqual(problems, []);
    await close();
  });

  it("predicts better as measurements arrive", async () => {
    const { page, problems, close } = await opened();
    await page.locator("[name=destination]").fill("3.4");
    await page.locator("#measured").fill("5");
    const early = metres((await facts(page)).deviation);
    await page.locator("#measured").fill("95");
    const late = metres((await facts(page)).deviation);
    assert.ok(early > 2000 && late < 400, `${early} m, then ${late} m`);
    await page.locator("#measured").fill("0");
    // a clock of the test's own: the page's timers run when it advances
    await page.clock.install();
    await page.locator("#play").click();
    await page.clock.runFor(1000);
    assert.ok(Number.parseInt((await facts(page))["so-far"], 10) >= 3);
    await page.locator("#play").click();
    const paused = (await facts(page))["so-far"];
    await page.clock.runFor(60_000);
    assert.equal((await facts(page))["so-far"], paused);
    assert.deepEqual(problems, []);
    await close();
  });

  it("states while it plays what the numbers show, and announces only where it stops", async () => {
    const { page, problems, close } = await opened();
    await page.locator("#measured").fill("40");
    await page.locator("#play").click();
    const frames = await page.evaluate(async () => {
      const frames = [];
      const text = (id) => document.querySelector(`#${id}`).textContent;
      while (Number.parseInt(text("so-far"), 10) < 48) {
        await new Promise(requestAnimationFrame);
        frames.push(["so-far", "deviation", "markov-deviation", "status", "announcement"].map(text));
      }
      return frames;
    });
    for (const [soFar, deviation, markov, status] of frames) {
      assert.equal(
        status,
        `After ${Number.parseInt(soFar, 10)} measurements the landing place is known to ${deviation}; to ${markov} from the motion alone.`,
      );
    }
    assert.ok(new Set(frames.map(([soFar]) => soFar)).size >= 5);
    assert.ok(new Set(frames.map((frame) => frame.at(-1))).size <= 3);
    await page.locator("#play").click();
    await page.waitForFunction(
      () => document.querySelector("#announcement").textContent === document.querySelector("#status").textContent,
    );
    assert.deepEqual(problems, []);
    await close();
  });

  it("follows what is set, and goes back to the paper's values", async () => {
    const { page, problems, close } = await opened();
    const paper = await drawing(page);
    for (const [name, value] of [
      ["noise", "-2.5"],
      ["origin", "3.4"],
      ["destination", "3.4"],
      ["correlation", "0.9"],
    ]) {
      const before = await drawing(page);
      await page.locator(`[name=${name}]`).fill(value);
      await facts(page);
      assert.ok((await drawing(page)) !== before, name);
    }
    await page.locator("#paper").click();
    await facts(page);
    assert.ok((await drawing(page)) === paper);
    await page.locator("#another").click();
    await facts(page);
    assert.ok((await drawing(page)) !== paper);
    assert.deepEqual(problems, []);
    await close();
  });

  it("shows lines of code that run as shown", async (test) => {
    const { page, close } = await opened();
    const file = new URL("../../www/sequences/example.js", import.meta.url);
    assert.equal(await page.locator("#listing").textContent(), (await readFile(file, "utf8")).trim());
    await close();
    const log = test.mock.method(console, "log", () => {});
    await import(file);
    const [middle, end] = log.mock.calls[0].arguments;
    assert.ok(Math.abs(middle[0] - 66_000) < 1000 && Math.abs(end[0] - 1000) < 1, `${middle} ${end}`);
  });

  it("is reached from the first page, and leads back", async () => {
    const { page, problems, close } = await open(browser, server.url);
    await page.locator('a[href$="sequences/index.html"]').first().click();
    await page.waitForFunction(isReady);
    await page.locator(".name a").click();
    await page.waitForSelector("button[data-destination]");
    assert.deepEqual(problems, []);
    await close();
  });
});
