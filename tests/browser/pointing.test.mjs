// The main thing, on the real thing: Chromium's mouse heads for every icon, and the page knows before it is there.
import assert from "node:assert/strict";
import { after, before, describe, it } from "node:test";
import { movement } from "./hand.mjs";
import { launch, middles, mouse, open, drag, read, serve } from "./support.mjs";

/** Shares of the screen's width and height; some lie outside of it. */
const STARTS = [
  [0.5, 1.08],
  [-0.02, 0.7],
  [1.01, 0.2],
  [0.286, 0.335],
  [0.714, 0.66],
  [0.43, -0.08],
];

describe("pointing", () => {
  let host, browser, opened;

  before(async () => {
    host = await serve();
    browser = await launch();
    opened = await open(browser, host.url);
  });
  after(async () => {
    await browser.close();
    await host.close();
  });

  it("has the right icon on top at 80% of the movement time in at least 95% of the movements", async (test) => {
    const { page, sins } = opened;
    const hand = await mouse(page);
    const icons = await middles(page);
    assert.equal(icons.length, 21);
    const box = await page.locator("#screen").boundingBox();
    const wrong = [];
    let count = 0;
    for (const [across, down] of STARTS) {
      const from = { x: box.x + across * box.width, y: box.y + down * box.height };
      for (const icon of icons) {
        count += 1;
        await hand.play([[0, from.x, from.y]]);
        await hand.rest(0.15);
        await hand.play(movement(from, icon, Math.min(icon.width, icon.height), { seed: count, share: 0.8 }));
        const shown = await read(page);
        assert.ok(Math.abs(shown.sum - 1) < 1e-4, `probabilities and none sum to ${shown.sum}`);
        if (shown.top.id !== icon.id) wrong.push(`${Math.round(from.x)},${Math.round(from.y)} to ${icon.id}: ${shown.top.id}`);
      }
    }
    test.diagnostic(`${count - wrong.length} of ${count} right at 80% of the time${wrong.map((each) => `\n  wrong: ${each}`).join("")}`);
    assert.ok(wrong.length <= 0.05 * count, wrong.join("\n"));
    assert.deepEqual(sins, []);
  });

  it("marks the most probable icon above the threshold, and says so in words", async () => {
    const { page } = opened;
    const hand = await mouse(page);
    const icons = await middles(page);
    const from = icons.find((icon) => icon.id === "fuel");
    const to = icons.find((icon) => icon.id === "seats");
    await hand.play([[0, from.x, from.y]]);
    await hand.rest(0.3);
    await hand.play(movement(from, to, to.width, { seed: 5 }));
    const shown = await read(page);
    assert.ok(shown.top.probability >= 0.6, `${shown.top.id} ${shown.top.probability}`);
    assert.deepEqual(shown.icons.filter((icon) => icon.predicted).map((icon) => icon.id), ["seats"]);
    await page.waitForFunction(() => document.querySelector("#status").textContent === "Heading for Seats.");
  });

  it("reports how much earlier than the press it was right", async () => {
    const { page } = opened;
    const hand = await mouse(page);
    const icons = await middles(page);
    const seats = icons.find((icon) => icon.id === "seats");
    await hand.press(seats);
    const lead = await page.locator("#lead").textContent();
    const [, early] = /^Seats: right (\d+) ms before the press$/.exec(lead) ?? assert.fail(lead);
    assert.ok(Number(early) > 150, lead);
    assert.equal(await page.locator("#median").textContent(), `${early} ms`);
    assert.equal(await page.locator("#early-right").textContent(), "100%");
    assert.equal(await page.locator("#early-wrong").textContent(), "0%");
    assert.equal((await read(page)).status, `Seats pressed: right ${early} ms before the press.`);
  });

  it("counts a press on another icon than the one that it had selected early", async () => {
    const { page, sins } = opened;
    const hand = await mouse(page);
    const icons = await middles(page);
    const from = icons.find((icon) => icon.id === "seats");
    const toward = icons.find((icon) => icon.id === "fuel");
    const pressed = icons.find((icon) => icon.id === "camera");
    await hand.rest(0.2);
    const there = movement(from, toward, toward.width, { seed: 6, share: 0.85 });
    const [turn, x, y] = there.at(-1);
    const back = movement({ x, y }, pressed, pressed.width, { seed: 7 });
    await hand.play([...there, ...back.slice(1).map(([time, ...place]) => [turn + time, ...place])]);
    await hand.press(pressed);
    assert.match(await page.locator("#lead").textContent(), /^Camera: right \d+ ms before the press$/);
    assert.equal(await page.locator("#early-right").textContent(), "50%");
    assert.equal(await page.locator("#early-wrong").textContent(), "50%");
    assert.equal(await page.locator("#presses").textContent(), "Over 2 presses");
    assert.deepEqual(sins, []);
  });

  it("learns from every sample once, also when the browser hands over many at a time", async () => {
    const { page } = opened;
    const hand = await mouse(page);
    const icons = await middles(page);
    const from = icons.find((icon) => icon.id === "help");
    const to = icons.find((icon) => icon.id === "media");
    const samples = movement(from, to, to.width, { seed: 11, share: 0.8 });
    await page.evaluate(() => {
      window.most = 0;
      addEventListener("pointermove", (event) => (window.most = Math.max(window.most, event.getCoalescedEvents().length)));
    });
    const shown = [];
    const most = [];
    for (const busy of [false, true]) {
      await hand.play([[0, from.x, from.y]]);
      await hand.rest(0.2);
      // A page that has no time for events finds them all in one afterwards.
      const work = page.evaluate((until) => {
        while (Date.now() < until);
      }, busy ? Date.now() + 1000 : 0);
      await Promise.all([work, hand.play(samples)]);
      shown.push(await read(page));
      most.push(await page.evaluate(() => window.most));
    }
    assert.equal(shown[1].top.id, "media");
    assert.ok(most[1] > 20, `at most ${most[1]} samples came at once`);
    for (const [index, icon] of shown[0].icons.entries()) {
      assert.ok(Math.abs(icon.probability - shown[1].icons[index].probability) < 0.02, `${icon.id}: ${icon.probability}, ${shown[1].icons[index].probability}`);
    }
  });

  it("starts afresh after a rest", async () => {
    const { page } = opened;
    const hand = await mouse(page);
    const icons = await middles(page);
    const from = icons.find((icon) => icon.id === "navigation");
    const via = icons.find((icon) => icon.id === "apps");
    const to = icons.find((icon) => icon.id === "radio");
    await hand.play([[0, from.x, from.y]]);
    await hand.rest(0.2);
    await hand.play(movement(from, via, via.width, { seed: 8 }));
    await hand.rest(0.2);
    const back = movement(via, to, to.width, { seed: 9, share: 0.8 });
    await hand.play(back);
    const afterDetour = await read(page);
    await hand.play([[0, 640, 780]]);
    await hand.rest(0.2);
    await hand.play([[0, via.x, via.y]]);
    await hand.rest(0.2);
    await hand.play(back);
    const direct = await read(page);
    assert.equal(afterDetour.top.id, "radio");
    for (const [index, icon] of direct.icons.entries()) {
      assert.ok(Math.abs(icon.probability - afterDetour.icons[index].probability) < 0.02, icon.id);
    }
  });

  it("predicts a finger that is dragged across a phone, and takes its lifting for the press", async () => {
    const phone = await open(browser, host.url, { viewport: { width: 390, height: 844 }, hasTouch: true, isMobile: true });
    const icons = await middles(phone.page);
    const from = icons.find((icon) => icon.id === "fuel");
    const to = icons.find((icon) => icon.id === "navigation");
    const samples = movement(from, to, to.height, { seed: 3, rate: 60 });
    let shown;
    await drag(phone.page, samples, async () => {
      shown = await read(phone.page);
    });
    assert.equal(shown.top.id, "navigation");
    assert.ok(Math.abs(shown.sum - 1) < 1e-4);
    assert.equal(await phone.page.evaluate(() => scrollY), 0);
    assert.match(await phone.page.locator("#lead").textContent(), /^Navigation: right \d+ ms before the press$/);
    assert.deepEqual(phone.sins, []);
    await phone.close();
  });
});
