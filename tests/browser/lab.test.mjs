// The lab: Chromium's own mouse and a finger make movements, which are scored, fitted, saved, opened and forgotten.
import assert from "node:assert/strict";
import { execFileSync } from "node:child_process";
import { mkdtempSync, readFileSync, rmSync, writeFileSync } from "node:fs";
import { tmpdir } from "node:os";
import { join } from "node:path";
import { describe, it } from "node:test";
import { root } from "../../scripts/run.mjs";
import { movement } from "./hand.mjs";
import { asked, makeMovements, scored } from "./lab.mjs";
import { drag, hosted, mouse, nextFrame, open, POLICY } from "./support.mjs";

const PATH = "lab/index.html";
const CALM = { reducedMotion: "reduce" };
const PHONE = { ...CALM, viewport: { width: 390, height: 844 }, hasTouch: true, isMobile: true };

/** What the table shows, by method: texts, and null for a dash. */
function table(page) {
  return page.evaluate(() => {
    const rows = [...document.querySelectorAll("#methods tbody tr")];
    return rows.map((row) => {
      const of = (name) => {
        const cell = row.querySelector(`[data-of=${name}]`);
        const text = cell.firstChild.textContent;
        return text === "–" ? null : Number.parseFloat(text);
      };
      const figures = Object.fromEntries(
        ["time", "lead", "right", "wrong", "loss", "calibration"].map((name) => [name, of(name)]),
      );
      return {
        method: row.dataset.method,
        leads: row.hasAttribute("data-leads"),
        note: row.querySelector(".note").textContent,
        ...figures,
      };
    });
  });
}

const fact = (page, name) => page.locator(`[data-fact=${name}]`).textContent();
const own = (page) => page.locator("#own-count").textContent();

/** The lines that the page saves. */
async function saved(page) {
  const [download] = await Promise.all([page.waitForEvent("download"), page.locator("#export").click()]);
  return { name: download.suggestedFilename(), text: readFileSync(await download.path(), "utf8") };
}

function give(page, text, name = "given.jsonl") {
  return page.locator("#file").setInputFiles({ name, mimeType: "application/jsonl", buffer: Buffer.from(text) });
}

/** What `npm run evaluate` makes of lines, by method. */
function evaluate(text) {
  const folder = mkdtempSync(join(tmpdir(), "whither-lab-"));
  try {
    const [file, report] = ["lab.jsonl", "report.json"].map((name) => join(folder, name));
    writeFileSync(file, text);
    const options = ["--json", report, "--charts", folder];
    execFileSync("node", ["scripts/tool.mjs", "evaluate", file, ...options], { cwd: root, stdio: "pipe" });
    const { sets } = JSON.parse(readFileSync(report, "utf8"));
    assert.equal(sets.length, 1);
    return Object.fromEntries(sets[0].methods.map(({ method, figures }) => [method, figures]));
  } finally {
    rmSync(folder, { recursive: true });
  }
}

/** That what is shown is this number, rounded. */
function assertShown(shown, number, digits, what) {
  assert.ok(Math.abs(shown - number) <= 0.5001 * 10 ** -digits, `${what}: ${shown} is shown, it is ${number}`);
}

describe("the lab", () => {
  const site = hosted();
  const fresh = (options = CALM) => open(site.browser, site.url, options, PATH);

  it("shows an example of the simulated hand at once, and calls it that", async () => {
    const { page, problems, close } = await fresh();
    assert.equal(await page.locator("#session-simulated").isChecked(), true);
    assert.equal(await page.locator("#simulated-count").textContent(), "24");
    assert.match(await page.locator("#status").textContent(), /^A simulated hand’s movements/);
    const rows = await table(page);
    assert.equal(rows.length, 11);
    assert.equal(rows[0].leads, true);
    assert.ok(rows.every(({ leads }, place) => leads === (place === 0)));
    const times = rows.map(({ time }) => time).filter((time) => time !== null);
    assert.equal(times.length, 10);
    assert.deepEqual(
      times,
      times.toSorted((a, b) => b - a),
    );
    const predicted = rows.at(-1);
    assert.equal(predicted.method, "predicted");
    assert.equal(predicted.note, "a simulated hand has no browser that predicts it");
    // methods that are the same by proof
    const [one, two] = ["algorithm1", "algorithm2"].map((id) => rows.find(({ method }) => method === id));
    assert.deepEqual([one.time, one.loss, one.calibration], [two.time, two.loss, two.calibration]);
    assert.equal(await page.locator("#field .paths .path").count(), 23);
    // the ten lines, which use another part of the package, count as the page does
    const words = await page.locator("#movement-words").textContent();
    const [, right, all] = /^Pointing model: the right target was on top after (\d+) of (\d+) samples up to the entry\.$/.exec(
      words,
    );
    const ran = `They ran just now, on the last movement: right after ${right} of ${all} samples up to the entry.`;
    await page.locator("#example-result", { hasText: ran }).waitFor();
    assert.deepEqual(problems, []);
    await close();
  });

  it("records a mouse, and its numbers are those of npm run evaluate over the lines that it saves", async () => {
    const { page, problems, close } = await fresh();
    await makeMovements(page, 6);
    assert.equal(await own(page), "6");
    assert.equal(await page.locator("#session-own").isChecked(), true);
    assert.match(
      await page.locator("#status").textContent(),
      /^Recorded, \d\.\d\d s: the pointing model was right for the last \d+ ms before the entry\.$/,
    );
    const rows = Object.fromEntries((await table(page)).map((row) => [row.method, row]));
    const { name, text } = await saved(page);
    assert.equal(name, "whither-lab.jsonl");
    const tracks = text
      .trim()
      .split("\n")
      .map((line) => JSON.parse(line));
    assert.equal(tracks.length, 6);
    for (const { samples } of tracks) assert.ok(samples.length > 25 && samples[0][0] === 0, `${samples.length} samples`);

    const figures = evaluate(text);
    for (const [method, tool] of [
      ["pointing", "whither, pointing model"],
      ["pseudoObservation", "whither, exact constant velocity"],
      ["nearest", "nearest"],
      ["foresight", "ForesightJS"],
    ]) {
      assert.equal(figures[tool].tracks, 6);
      for (const [figure, digits] of [
        ["time", 0],
        ["lead", 0],
        ["loss", 3],
        ["calibration", 3],
      ]) {
        if (figures[tool][figure] === null) assert.equal(rows[method][figure], null);
        else assertShown(rows[method][figure], figures[tool][figure], digits, `${figure} of ${method}`);
      }
    }
    const grid = Object.entries(figures).filter(([tool]) => tool.startsWith("extrapolation"));
    assertShown(rows.extrapolation.time, Math.max(...grid.map(([, { time }]) => time)), 0, "the best extrapolation");
    assert.equal(await fact(page, "time"), `${rows.pointing.time}%`);
    assert.equal(await fact(page, "loss"), `${rows.pointing.loss.toFixed(3)} nats`);
    // Chromium expects a pointer of its own mouse
    assert.ok(rows.predicted.time > 0, JSON.stringify(rows.predicted));
    assert.deepEqual(problems, []);
    await close();
  });

  it("opens what it saves, once, and keeps what is good of a broken file", async () => {
    const { page, problems, close } = await fresh();
    await page.locator("#hand").click();
    await scored(page);
    assert.equal(await page.locator("#simulated-count").textContent(), "44");
    const before = await table(page);
    const { name, text } = await saved(page);
    assert.equal(name, "whither-simulated.jsonl");
    await give(page, text);
    await scored(page);
    assert.equal(await own(page), "44");
    assert.match(await page.locator("#status").textContent(), /^Read 44 movements\.$/);
    const figuresOf = (rows) => rows.map(({ note, ...figures }) => figures);
    assert.deepEqual(figuresOf(await table(page)), figuresOf(before));
    assert.equal((await saved(page)).text, text);

    const lines = text.trim().split("\n");
    await give(page, text);
    await page.waitForFunction(() => document.querySelector("#status").textContent.includes("44 were here already."));
    const other = lines[0].replace(/"id":"[^"]*"/, '"id":"another"');
    await give(page, [lines[0], "{ broken", "", lines[1].replace('"samples"', '"sample"'), other].join("\n"), "half.jsonl");
    await page.waitForFunction(() => document.querySelectorAll("#problems li").length === 2);
    const problemsListed = await page.locator("#problems li").allTextContents();
    assert.equal(problemsListed[0], "half.jsonl, line 2: is no JSON: { broken");
    assert.equal(
      problemsListed[1],
      "half.jsonl, line 4: sample: unknown key, expected one of id, user, targets, target, samples",
    );
    assert.match(
      await page.locator("#status").textContent(),
      /^Read 1 movement\. 1 were here already\. What could not be read is listed/,
    );
    await scored(page);
    assert.equal(await own(page), "45");
    assert.equal(await fact(page, "movements"), "45");
    assert.deepEqual(problems, []);
    await close();
  });

  it("lights targets as much as they are probable while the pointer moves, where that is wanted", async () => {
    const { page, problems, close } = await fresh();
    const hand = await mouse(page);
    const lights = () =>
      page.evaluate(() =>
        [...document.querySelectorAll("#field .target")].map((target) => ({
          asked: target.classList.contains("asked"),
          light: Number(target.style.getPropertyValue("--probability")),
        })),
      );
    const most = async () => (await lights()).reduce((best, each) => (each.light > best.light ? each : best));
    const to = await asked(page);
    const from = { x: to.x - 40, y: to.y - 250 };
    await page.waitForFunction(() => document.documentElement.hasAttribute("data-live"));
    const path = movement(from, to, to.width, { seed: 2, share: 0.9 });
    await hand.play(path);
    await nextFrame(page);
    const top = await most();
    assert.ok(top.asked && top.light > 0.6, JSON.stringify(top));
    const sum = (await lights()).reduce((total, { light }) => total + light, 0);
    assert.ok(Math.abs(sum - 1) < 0.01, `${sum}`);
    assert.equal(await fact(page, "now"), `${(100 * top.light).toFixed(0)}%, the right one`);
    await hand.press(to);
    await scored(page);
    assert.equal((await most()).light, 0);
    assert.equal(await fact(page, "now"), "–");
    await page.locator("#live").uncheck();
    await makeMovements(page, 1);
    await hand.play(movement(to, await asked(page), to.width, { seed: 3, share: 0.9 }));
    assert.equal((await most()).light, 0);
    assert.deepEqual(problems, []);
    await close();
  });

  it("takes a file that is dropped on it", async () => {
    const { page, problems, close } = await fresh();
    const { text } = await saved(page);
    await page.evaluate((text) => {
      const files = new DataTransfer();
      files.items.add(new File([text], "dropped.jsonl"));
      for (const type of ["dragenter", "dragover", "drop"]) {
        document
          .querySelector("#what")
          .dispatchEvent(new DragEvent(type, { bubbles: true, cancelable: true, dataTransfer: files }));
      }
    }, text);
    await page.waitForFunction(() => document.querySelector("#own-count").textContent === "24");
    assert.equal(await page.evaluate(() => document.documentElement.hasAttribute("data-dropping")), false);
    assert.deepEqual(problems, []);
    await close();
  });

  it("fits with progress, can be cancelled, and states the gain on movements left out", async () => {
    const { page, problems, close } = await fresh({ ...CALM, permissions: ["clipboard-read", "clipboard-write"] });
    assert.equal(await page.locator("#verdict").textContent(), "6 more movements to go: it takes at least 30.");
    assert.equal(await page.locator("#fit").isDisabled(), true);
    await page.locator("#hand").click();
    await scored(page);
    assert.equal(await page.locator("#verdict").textContent(), "44 movements: enough for 2 constants, all five from 75 on.");

    await page.locator("#fit").click();
    assert.equal(await page.locator("#fit").isDisabled(), true);
    await page.waitForFunction(() => document.querySelector("#fitting").value > 0);
    await page.locator("#cancel").click();
    assert.equal(await page.locator("#verdict").textContent(), "Cancelled: nothing was learnt.");
    assert.equal(await page.locator("#fitting").isVisible(), false);

    await page.evaluate(() => {
      window.shares = [];
      const bar = document.querySelector("#fitting");
      const keep = () => {
        if (bar.checkVisibility()) window.shares.push(bar.value);
        requestAnimationFrame(keep);
      };
      keep();
    });
    await page.locator("#fit").click();
    await page.locator("#copy:enabled").waitFor({ timeout: 60_000 });
    const shares = await page.evaluate(() => window.shares);
    assert.deepEqual(
      shares,
      shares.toSorted((a, b) => a - b),
    );
    assert.ok(new Set(shares).size > 3, `${shares}`);
    const verdict = await page.locator("#verdict").textContent();
    const found =
      /^(A gain of|No gain:).*\(95% interval (−?[\d.]+) to (−?[\d.]+)\).* Over 44 movements, each third scored with what was learnt from the other two: log loss ([\d.]+) nats as shipped, ([\d.]+) fitted; right ([\d.]+)% of the time, then ([\d.]+)%\.$/.exec(
        verdict,
      );
    assert.ok(found, verdict);
    const [, kind, low, , before] = found;
    assert.equal(kind, Number(low.replace("−", "-")) > 0 ? "A gain of" : "No gain:");
    // as shipped it scores what the table has
    const pointing = (await table(page)).find(({ method }) => method === "pointing");
    assert.equal(Number(before), pointing.loss);
    const sections = JSON.parse(await page.locator("#constants-code").textContent());
    assert.deepEqual(Object.keys(sections), ["pointing"]);
    const listed = await page.locator("#constants .fact", { hasText: "→" }).locator("dt").allTextContents();
    assert.deepEqual(listed, ["pointing.power.to", "pointing.timeToGo.median"]);
    assert.ok(sections.pointing.power.to > 0);

    // watch and a predictor take them
    await page.locator("#copy").click();
    await page.locator("#copy", { hasText: "Copied" }).waitFor();
    const constants = JSON.parse(await page.evaluate(() => navigator.clipboard.readText()));
    const { init, pointerScenario, Predictor } = await import("whither");
    const { init: initPointing, PointerPredictor } = await import("whither/pointing");
    await Promise.all([init(), initPointing()]);
    const targets = [
      { id: "a", x: 100, y: 100, width: 40, height: 40 },
      { id: "b", x: 400, y: 200, width: 40, height: 40 },
    ];
    const [one, other] = [
      new Predictor({ ...pointerScenario(targets), ...constants }),
      new PointerPredictor(targets, { constants }),
    ];
    for (const predictor of [one, other]) {
      predictor.observe(0, [250, 300]);
      predictor.observe(0.05, [270, 290]);
    }
    assert.ok(Math.abs(one.probabilities()[0] - other.probabilities()[0]) < 1e-9);
    assert.deepEqual(problems, []);
    await close();
  });

  it("records a finger that drags the ring, and takes a swipe and a tap for no movement", async () => {
    const { page, problems, close } = await fresh(PHONE);
    await page.locator("#field").scrollIntoViewIfNeeded();
    const to = await asked(page);
    const box = await page.locator("#handle").boundingBox();
    const from = { x: box.x + box.width / 2, y: box.y + box.height / 2 };
    assert.ok(box.width >= 44);
    await page.touchscreen.tap(to.x, to.y);
    assert.match(await page.locator("#status").textContent(), /^A tap has no movement to predict from/);
    assert.equal(await own(page), "0");
    await drag(page, movement(from, to, to.width, { seed: 3 }));
    await scored(page);
    assert.equal(await own(page), "1");
    assert.match(await page.locator("#status").textContent(), /^Recorded, /);
    const [track] = (await saved(page)).text
      .trim()
      .split("\n")
      .map((line) => JSON.parse(line));
    assert.ok(track.samples.length > 5);
    const [, x, y] = track.samples.at(-1);
    const [tx, ty, width] = track.targets[track.target];
    assert.ok(Math.abs(x - tx) <= width / 2 && Math.abs(y - ty) <= width / 2);
    // beside it
    await page.locator("#field").scrollIntoViewIfNeeded();
    const next = await page.locator("#handle").boundingBox();
    const start = { x: next.x + next.width / 2, y: next.y + next.height / 2 };
    await drag(page, [
      [0, start.x, start.y],
      [0.05, start.x + 4, start.y + 4],
      [0.1, start.x + 30, start.y + 40],
    ]);
    await page.waitForFunction(() => document.querySelector("#status").textContent.startsWith("Lifted beside it"));
    assert.equal(await own(page), "1");
    assert.deepEqual(problems, []);
    await close();
  });

  it("keeps movements only where it is asked to, and forgets everything", async () => {
    const { page, problems, close } = await fresh();
    await makeMovements(page, 2);
    const stored = () =>
      page.evaluate(async () => [Object.keys(localStorage), (await indexedDB.databases()).map(({ name }) => name)]);
    assert.deepEqual(await stored(), [[], []]);
    await page.reload();
    await page.waitForFunction(() => document.documentElement.dataset.ready);
    assert.equal(await own(page), "0");

    await makeMovements(page, 1);
    await page.locator("#keep").check();
    await page.waitForFunction(() => document.querySelector("#status").textContent.startsWith("Your movements are kept"));
    await makeMovements(page, 2, 10);
    await page.reload();
    await page.waitForFunction(() => document.documentElement.dataset.ready);
    assert.equal(await own(page), "3");
    assert.equal(await page.locator("#keep").isChecked(), true);
    assert.equal(await page.locator("#status").textContent(), "3 movements from before. For more, press the marked target.");
    await scored(page);
    // where the browser expected the pointer is kept with them
    assert.ok((await table(page)).find(({ method }) => method === "predicted").time > 0);

    await page.locator("#forget").click();
    assert.equal(await own(page), "3");
    assert.equal(await page.locator("#forget").textContent(), "Press again to forget 3 movements");
    await page.locator("#forget").click();
    await page.waitForFunction(() => document.querySelector("#status").textContent.startsWith("Forgotten"));
    assert.equal(await own(page), "0");
    assert.deepEqual(await stored(), [[], []]);
    assert.equal(await page.locator("#keep").isChecked(), false);
    assert.equal(await page.locator("#session-simulated").isChecked(), true);
    await page.reload();
    await page.waitForFunction(() => document.documentElement.dataset.ready);
    assert.equal(await own(page), "0");
    assert.deepEqual(problems, []);
    await close();
  });

  it("records a pen that hovers", async () => {
    const { page, problems, close } = await fresh();
    const session = await page.context().newCDPSession(page);
    const to = await asked(page);
    const from = { x: to.x - 200, y: to.y - 150 };
    const pen = (type, { x, y }, more) => session.send("Input.dispatchMouseEvent", { type, x, y, pointerType: "pen", ...more });
    const start = Date.now() / 1000;
    for (const [time, x, y] of movement(from, to, to.width, { seed: 4 })) {
      await pen("mouseMoved", { x, y }, { timestamp: start + time });
    }
    const button = { button: "left", clickCount: 1, timestamp: start + 2 };
    await pen("mousePressed", to, { ...button, buttons: 1 });
    await pen("mouseReleased", to, button);
    await scored(page);
    assert.equal(await own(page), "1");
    assert.match(await page.locator("#status").textContent(), /^Recorded, /);
    assert.deepEqual(problems, []);
    await close();
  });

  it("takes a press beside the target, and one without a movement, for none", async () => {
    const { page, problems, close } = await fresh();
    const hand = await mouse(page);
    const to = await asked(page);
    await hand.play(movement({ x: to.x - 150, y: to.y - 80 }, { x: to.x - 90, y: to.y }, to.width, { seed: 1 }));
    await hand.press({ x: to.x - 90, y: to.y });
    assert.equal(await page.locator("#status").textContent(), "Beside it: press the marked target.");
    assert.equal(await page.locator("#session-simulated").isChecked(), true);
    await page.mouse.move(10, 10);
    await hand.press(to);
    assert.match(await page.locator("#status").textContent(), /^Pressed, without a movement/);
    assert.equal(await own(page), "0");
    assert.deepEqual(problems, []);
    await close();
  });

  it("sorts by any column, and shows the pictures of any method, by the keyboard too", async () => {
    const { page, problems, close } = await fresh();
    await page.locator("th[data-column=loss] button").focus();
    await page.keyboard.press("Enter");
    assert.equal(await page.locator("th[aria-sort]").getAttribute("data-column"), "loss");
    const losses = (await table(page)).map(({ loss }) => loss).filter((loss) => loss !== null);
    assert.deepEqual(
      losses,
      losses.toSorted((a, b) => a - b),
    );
    await page.locator("[data-method=nearest] .method").focus();
    await page.keyboard.press("Space");
    await nextFrame(page);
    assert.equal(await page.locator(".method[aria-pressed=true]").textContent(), "Nearest target");
    assert.equal(
      await page.locator("#calibration-words").textContent(),
      "Nearest target names one target and gives no probability.",
    );
    assert.match(
      await page.locator("#movement-words").textContent(),
      /^Nearest target: the right target was on top after \d+ of \d+/,
    );
    await page.locator("[data-method=bridging] .method").click();
    await nextFrame(page);
    const shown = await page.locator("#calibration-words").textContent();
    const error = (await table(page)).find(({ method }) => method === "bridging").calibration;
    assert.ok(shown.startsWith(`Bridging distributions: calibration error ${error.toFixed(3)} over `), shown);
    assert.deepEqual(problems, []);
    await close();
  });

  it("plays the simulated hand where motion is welcome, stops it, and has three arrangements", async () => {
    const { page, problems, close } = await fresh({});
    await page.locator("input[value=grid]").check();
    assert.equal(await page.locator("#field .target").count(), 28);
    await scored(page);
    assert.equal(await page.locator("#simulated-count").textContent(), "48");
    await page.locator("#hand").click();
    assert.equal(await page.locator("#hand").textContent(), "Stop the simulated hand");
    await page.waitForFunction(() => Number(document.querySelector("#simulated-count").textContent) >= 49);
    assert.equal(await page.locator("#field .arrow").getAttribute("visibility"), "visible");
    await page.locator("#hand").click();
    assert.equal(await page.locator("#hand").textContent(), "Let the simulated hand do 20");
    assert.equal(await page.locator("#field .arrow").getAttribute("visibility"), "hidden");
    await page.locator("input[value=scatter]").check();
    assert.ok((await page.locator("#field .target").count()) >= 12);
    await scored(page);
    assert.deepEqual(problems, []);
    await close();
  });
});

describe("the lab where WebAssembly is forbidden", () => {
  const site = hosted(POLICY.replace("'wasm-unsafe-eval'", ""));

  it("states that, and shows no number", async () => {
    const { page, close } = await open(site.browser, site.url, CALM, PATH);
    assert.equal(await page.evaluate(() => "failed" in document.documentElement.dataset), true);
    assert.match(await page.locator("#status").textContent(), /^This page could not start: .*wasm-unsafe-eval/);
    assert.deepEqual(
      (await table(page)).filter(({ time, loss }) => time !== null || loss !== null),
      [],
    );
    await close();
  });
});
