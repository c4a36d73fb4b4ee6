// What the car's screen is for, in ten seconds; its evidence; phones; the controls; colours of the chart.
import assert from "node:assert/strict";
import { readFileSync } from "node:fs";
import { join } from "node:path";
import { describe, it } from "node:test";
import { gzipSync } from "node:zlib";
import { root } from "../../scripts/run.mjs";
import { head, hosted, middles, mouse, open, REST } from "./support.mjs";

const rect = (page, selector) =>
  page.evaluate((selector) => document.querySelector(selector).getBoundingClientRect().toJSON(), selector);
const text = (page, id) => page.evaluate((id) => document.getElementById(id).textContent, id);

describe("the car's screen", () => {
  const site = hosted();
  const fresh = (options) => open(site.browser, site.url, options);

  it("states what it is, and how to get it, in view with the panel and the sentence at 1280 x 800", async () => {
    const { page, problems, close } = await fresh({ reducedMotion: "reduce" });
    assert.equal(
      await page.locator("h1").textContent(),
      "Your interface knows what people are heading for, before they get there.",
    );
    for (const selector of ["h1", "#install", "#copy", "#particulars", ".on-page", "#screen", "#status", "#panel"]) {
      const { top, bottom } = await rect(page, selector);
      assert.ok(top >= 0 && bottom <= 800 && bottom > top, `${selector}: ${top} to ${bottom}`);
    }
    const [, now, later] =
      /^(\d+\.\d) kB with your page, (\d+\.\d) kB once a pointer moves, under gzip\. MIT or Apache-2\.0\.$/.exec(
        await text(page, "particulars"),
      );
    const gzipped = (...files) =>
      files.reduce((sum, file) => sum + gzipSync(readFileSync(join(root, "dist", file))).length, 0) / 1000;
    assert.ok(Math.abs(now - gzipped("dom.js", "error.js")) < 0.5, now);
    assert.ok(Math.abs(later - gzipped("pointing.js", "pointing-bytes.js", "prediction.js")) < 1, later);
    for (const [name, target] of [
      ["Code", "#code"],
      ["How it works", "#how"],
      ["Papers", "#papers"],
    ]) {
      assert.equal(await page.locator(".on-page").getByRole("link", { name, exact: true }).getAttribute("href"), target);
      assert.equal(await page.locator(target).count(), 1);
    }
    assert.deepEqual(problems, []);
    await close();
  });

  it("has a line that installs the package which lies beside it, and copies it", async () => {
    const { page, close } = await fresh({ permissions: ["clipboard-read", "clipboard-write"] });
    const line = await text(page, "install");
    const [, address] = /^npm install (\S+\/whither\.tgz)$/.exec(line) ?? assert.fail(line);
    const response = await page.request.get(address);
    assert.equal(response.status(), 200);
    assert.deepEqual([...(await response.body()).subarray(0, 2)], [0x1f, 0x8b], "under gzip");
    await page.locator("#copy").click();
    await page.waitForFunction(() => document.querySelector("#copy").textContent === "Copied");
    assert.equal(await page.evaluate(() => navigator.clipboard.readText()), line);
    await close();
  });

  it("shows an example in its rows until somebody moves, then the last movement's, faint", async () => {
    const { page, close } = await fresh({ reducedMotion: "reduce" });
    const shown = () =>
      page.evaluate(() => ({
        note: document.querySelector("#panel-note").textContent,
        faint: document.querySelector("#panel").hasAttribute("data-faint"),
        first: document.querySelector(".row").textContent,
      }));
    const example = await shown();
    assert.deepEqual([example.note, example.faint], ["An example, until you move", true]);
    assert.match(example.first, /^Seats5\d%$/);
    const hand = await mouse(page);
    // where it is does not show where it goes
    await hand.play([[0, 300, 300]]);
    await hand.rest(REST + 0.1);
    assert.deepEqual(await shown(), example);
    const moving = page.waitForFunction(() => !document.querySelector("#panel").hasAttribute("data-faint"));
    await head(page, hand, "fuel", "weather", { seed: 5 });
    await moving;
    await page.waitForFunction(() => document.querySelector("#panel").hasAttribute("data-faint"));
    const last = await shown();
    assert.equal(last.note, "Your last movement");
    assert.match(last.first, /^Weather[89]\d%$/);
    await close();
  });

  it("has one slider for the threshold: the ring's, and that of the figures of recorded hands", async () => {
    const { page, problems, close } = await fresh({ reducedMotion: "reduce" });
    const slider = page.getByRole("slider", { name: "The ring closes at" });
    assert.equal(await slider.count(), 1);
    assert.equal(await slider.getAttribute("aria-valuetext"), "80%");
    const rows = () =>
      page.evaluate(() =>
        [...document.querySelectorAll("#recorded tr")].map((row) =>
          [...row.querySelectorAll("td")].map((cell) => cell.textContent),
        ),
      );
    const points = () =>
      page.evaluate(() => [...document.querySelectorAll(".curve-point")].map((point) => point.getAttribute("cx")));
    assert.deepEqual(await rows(), [
      ["88%", "12%", "0.63 s"],
      ["75%", "13%", "0.61 s"],
      ["72%", "20%", "0.38 s"],
    ]);
    assert.match(
      await text(page, "worth"),
      /^At 80%, of 6396 .* in 72% to 88%, 0\.38 s to 0\.63 s before the press, .* in 12% to 20%\.$/,
    );
    const before = await points();
    await slider.fill("6");
    assert.equal(await text(page, "threshold-now"), "95%");
    assert.deepEqual((await rows())[2], ["68%", "4%", "0.32 s"]);
    assert.match(await text(page, "worth"), /^At 95%/);
    assert.notDeepEqual(await points(), before);
    // at 95% the calm hand of these tests closes no ring that it closes at 50%
    const hand = await mouse(page);
    await page.evaluate(() => scrollTo(0, 0));
    const { shown } = await head(page, hand, "help", "radio", { seed: 8, share: 0.85 });
    await slider.fill("0");
    await page.evaluate(() => scrollTo(0, 0));
    const { shown: again } = await head(page, hand, "help", "radio", { seed: 8, share: 0.85 });
    assert.deepEqual(
      [shown, again].map(({ icons }) => icons.some((icon) => icon.predicted)),
      [false, true],
    );
    assert.deepEqual(problems, []);
    await close();
  });

  it("shows of recorded hands what docs/pointing.md has", async () => {
    const { page, close } = await fresh({ reducedMotion: "reduce" });
    const table = readFileSync(new URL("../../docs/pointing.md", import.meta.url), "utf8");
    const row = /^\| \.80 \|(.*)\|$/m.exec(table) ?? assert.fail("no row of .80");
    const printed = row[1].split("|").map((cell) => {
      const [right, wrong, , leads] = cell.split("/").map((part) => part.trim());
      return [right, Number.parseFloat(wrong), leads].map(Number);
    });
    const shown = await page.evaluate(() =>
      [...document.querySelectorAll("#recorded tr")].map((row) =>
        [...row.querySelectorAll("td")].map((cell) => Number.parseFloat(cell.textContent)),
      ),
    );
    shown.forEach(([right, wrong, lead], set) => {
      const [wantedRight, wantedWrong, wantedLead] = printed[set];
      assert.deepEqual(
        [right, wrong, lead],
        [Math.round(wantedRight), Math.round(wantedWrong), Number((wantedLead / 1000).toFixed(2))],
      );
    });
    await close();
  });

  for (const viewport of [
    { width: 390, height: 844 },
    { width: 360, height: 640 },
  ]) {
    it(`has the outcome in view after a press anywhere in the panel, at ${viewport.width} x ${viewport.height}`, async () => {
      const { page, problems, close } = await fresh({ viewport, hasTouch: true, isMobile: true, reducedMotion: "reduce" });
      for (const id of ["navigation", "apps", "help"]) {
        await page.evaluate((id) => document.querySelector(`[data-destination=${id}]`).scrollIntoView({ block: "center" }), id);
        const icon = (await middles(page)).find((each) => each.id === id);
        await page.touchscreen.tap(icon.x, icon.y);
        await page.waitForFunction((id) => document.querySelector(`[data-destination=${id}]`).matches("[data-pressed]"), id);
        const { top, bottom } = await rect(page, "#status");
        assert.ok(top >= 0 && bottom <= viewport.height, `${id}: ${top} to ${bottom}`);
        assert.match(await text(page, "status"), new RegExp(`^${id}`, "i"));
        const on = await page.evaluate(({ x, y }) => document.elementFromPoint(x, y)?.closest("#status") !== null, {
          x: 30,
          y: (top + bottom) / 2,
        });
        assert.ok(on, "nothing covers it");
      }
      assert.deepEqual(problems, []);
      await close();
    });
  }

  it("leaves no hole where the controls are open, and moves nothing above them", async () => {
    const { page, close } = await fresh({ reducedMotion: "reduce" });
    const before = await rect(page, "#status");
    await page.locator(".controls summary").click();
    const [controls, stage, status] = await Promise.all([".controls", ".stage", "#status"].map((each) => rect(page, each)));
    assert.deepEqual(status, before);
    assert.ok(controls.width > 0.99 * stage.width, `${controls.width} of ${stage.width} px`);
    const rows = await page.evaluate(() => {
      const tops = [...document.querySelectorAll(".controls fieldset")].map((each) => each.getBoundingClientRect());
      return new Set(tops.map(({ top }) => top)).size;
    });
    assert.equal(rows, 1, "they lie beside one another");
    await close();
  });

  for (const colorScheme of ["dark", "light"]) {
    it(`tells neighbouring bands of the chart apart, and their names, ${colorScheme}`, async () => {
      const { page, close } = await fresh({ colorScheme, reducedMotion: "reduce" });
      const low = await page.evaluate(() => {
        const canvas = document.createElement("canvas").getContext("2d", { willReadFrequently: true });
        const style = getComputedStyle(document.querySelector("#chart"));
        const luminance = (name) => {
          canvas.fillStyle = style.getPropertyValue(`--${name}`);
          canvas.fillRect(0, 0, 1, 1);
          const [red, green, blue] = [...canvas.getImageData(0, 0, 1, 1).data].map((part) =>
            part / 255 <= 0.04045 ? part / 255 / 12.92 : ((part / 255 + 0.055) / 1.055) ** 2.4,
          );
          return 0.2126 * red + 0.7152 * green + 0.0722 * blue;
        };
        const contrast = (one, other) => {
          const [dark, bright] = [luminance(one), luminance(other)].sort((a, b) => a - b);
          return (bright + 0.05) / (dark + 0.05);
        };
        const own = [1, 2, 3, 4, 5].map((place) => `band-${place}`);
        const neighbours = [
          ...own.slice(1).map((name, place) => [own[place], name]),
          ...own.map((name) => [name, "band-others"]),
          ...own.map((name) => [name, "band-none"]),
          ["band-others", "band-none"],
        ];
        const named = [
          ...own.map((name, place) => [name, place % 2 ? "on-band" : "on-light"]),
          ["band-others", "on-band"],
          ["band-none", "text"],
        ];
        return [...neighbours.filter((pair) => contrast(...pair) < 1.5), ...named.filter((pair) => contrast(...pair) < 4.5)].map(
          (pair) => `${pair.join(", ")}: ${contrast(...pair).toFixed(2)}`,
        );
      });
      assert.deepEqual(low, []);
      await close();
    });
  }
});
