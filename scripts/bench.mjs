// `npm run bench`: what a step costs, compared with its peers, in one run: tables here, the numbers in target/bench/result.json.
// `npm run bench -- --quick` takes less care, and under a minute once everything is built. `npm run bench -- --links FILE...`: instead,
// what loading links ahead asks of a server, with recorded movements.
import { cpSync, mkdirSync, readFileSync, rmSync, writeFileSync } from "node:fs";
import { arch, cpus } from "node:os";
import { join } from "node:path";
import { cases } from "../benches/cases.mjs";
import { measureDom } from "../benches/dom.mjs";
import { measureLinks } from "../benches/links.mjs";
import { median } from "../benches/measure.mjs";
import { measureNumpy } from "../benches/numpy.mjs";
import { report } from "../benches/report.mjs";
import { exponents, INTERVAL, scenario, sweep } from "../benches/scenarios.mjs";
import { checkUnit } from "../benches/yardstick.mjs";
import { build } from "./build.mjs";
import { compile } from "./cargo.mjs";
import { ensureChromium, launch } from "./chromium.mjs";
import { Failure, main, root, run } from "./run.mjs";
import { serve } from "./serve.mjs";
import { sizes } from "./size.mjs";

const folder = join(root, "target/bench");

/** How much slower than this machine those are whose start is measured. */
const THROTTLES = [1, 4, 6];

/** Movements of each file of recordings. */
const MOVEMENTS = 20;

async function benchLinks(files) {
  if (files.length === 0) throw new Failure("npm run bench -- --links FILE...: recorded movements");
  await ensureChromium();
  await build();
  const browser = await launch();
  try {
    await measureLinks(browser, files, MOVEMENTS);
  } finally {
    await browser.close();
  }
}

async function bench() {
  const [first, ...files] = process.argv.slice(2);
  if (first === "--links") return benchLinks(files);
  const unknown = process.argv.slice(2).find((option) => option !== "--quick");
  if (unknown !== undefined) throw new Failure(`there is no option ${unknown}: npm run bench -- --quick, or --links FILE...`);
  const quick = process.argv.includes("--quick");
  await ensureChromium();
  await build();
  rmSync(folder, { recursive: true, force: true });
  mkdirSync(folder, { recursive: true });
  const { init, ...whither } = await import("whither");
  await init();
  const list = cases({ quick });
  const literal = list.find(({ group, method, count }) => group === "methods" && method === "algorithm1" && count === 21);
  const result = {
    date: new Date().toISOString().slice(0, 10),
    machine: `${cpus()[0]?.model.trim() ?? "unknown"}, ${cpus().length} cores, ${process.platform} ${arch()}`,
    quick,
    cases: list,
    native: await natively(list, whither, quick),
    node: await inNode("node", quick),
    memory: await inNode("memory", quick),
    numpy: await measureNumpy(whither, literal, folder),
    chromium: await inChromium(quick),
    sizes: sizes(),
  };
  writeFileSync(join(folder, "result.json"), `${JSON.stringify(result, null, 2)}\n`);
  report(result);
  console.log("The same numbers: target/bench/result.json");
}

/** The last thing that a script of benches/ writes. */
async function inNode(name, quick) {
  const file = join(folder, `${name}.json`);
  await run(process.execPath, [`benches/${name}.mjs`, file, ...(quick ? ["--quick"] : [])]);
  return JSON.parse(readFileSync(file, "utf8"));
}

/** Microseconds and the ratio to as many `exp` by the names of cases. */
async function natively(list, { pointerScenario }, quick) {
  const given = list.map((one) => ({ ...one, scenario: scenario(one, pointerScenario) }));
  const file = { positions: sweep, interval: INTERVAL, exponents: Array.from(exponents(1000)), cases: given };
  writeFileSync(join(folder, "native.json"), JSON.stringify(file));
  const [warmUp, measurement] = quick ? [0.05, 0.1] : [0.3, 1];
  const criterion = ["--noplot", "--quiet", "--nresamples", "1000", "--sample-size", "10"];
  const times = ["--warm-up-time", `${warmUp}`, "--measurement-time", `${measurement}`];
  const which = ["--package", "benches", "--profile", "tools", "--target-dir", "target"];
  const env = { CRITERION_HOME: join(folder, "criterion") };
  await compile("compiling the native part", ["bench", "--no-run", ...which]);
  await run("cargo", ["bench", "--quiet", ...which, "--", ...criterion, ...times], { env });
  const call = (way, round) => nanoseconds(`exp ${way} ${round}`) / file.exponents.length;
  const rounds = ["first", "second", "third"];
  const units = rounds.map((round) => ({ plain: call("plain", round), unrolled: call("unrolled", round) }));
  const exp = checkUnit(
    "natively",
    units,
    rounds.map((round) => call("check", round)),
  );
  const result = {};
  for (const { name, pairs } of list) {
    const time = nanoseconds(name);
    result[name] = { microseconds: time / 1000, ratio: time / (exp.unit * pairs) };
  }
  return { exp, cases: result };
}

function nanoseconds(name) {
  const file = join(folder, "criterion/native", name, "new/estimates.json");
  return JSON.parse(readFileSync(file, "utf8")).median.point_estimate;
}

async function inChromium(quick) {
  const page = join(folder, "page");
  mkdirSync(page);
  cpSync(join(root, "dist"), join(page, "dist"), { recursive: true });
  writeFileSync(join(page, "index.html"), "<!doctype html><meta charset=utf-8><title>bench</title><body></body>\n");
  const esbuild = await import("esbuild");
  await esbuild.build({
    absWorkingDir: root,
    entryPoints: ["benches/browser.mjs", "benches/dom-page.mjs"],
    outdir: page,
    bundle: true,
    splitting: true,
    format: "esm",
  });
  // isolated, a page has the finer clock
  const headers = { "Cross-Origin-Opener-Policy": "same-origin", "Cross-Origin-Embedder-Policy": "require-corp" };
  const server = await serve(page, { headers });
  const browser = await launch();
  try {
    const start = await starts(browser, server.url, quick ? 3 : 9);
    const tab = await browser.newPage();
    const failed = new Promise((_, reject) => tab.on("pageerror", reject));
    await tab.exposeFunction("progress", (name) => console.log(name));
    await tab.goto(server.url);
    await tab.addScriptTag({ type: "module", content: 'import "/browser.js"; globalThis.ready = true;' });
    await tab.waitForFunction(() => globalThis.ready);
    const measured = await Promise.race([failed, tab.evaluate((quick) => globalThis.measure(quick), quick)]);
    await tab.close();
    const dom = await measureDom(browser, server.url, quick);
    return { version: browser.version(), start, ...measured, dom };
  } finally {
    await browser.close();
    await server.close();
  }
}

/** Milliseconds from the import of each entry to the first prediction, by a processor that is slowed down; medians over pages. */
async function starts(browser, url, pages) {
  const result = [];
  for (const throttle of THROTTLES) {
    console.log(`Chromium: init() on a processor ${throttle} times as slow`);
    const measured = { index: [], pointing: [] };
    for (let k = 0; k < 2 * pages; k++) {
      const entry = k % 2 === 0 ? "index" : "pointing";
      const context = await browser.newContext();
      const page = await context.newPage();
      const session = await context.newCDPSession(page);
      await page.goto(url);
      await session.send("Emulation.setCPUThrottlingRate", { rate: throttle });
      measured[entry].push(await page.evaluate(firstPrediction, entry));
      await context.close();
    }
    result.push({ throttle, whither: median(measured.index), pointing: median(measured.pointing) });
  }
  return result;
}

/** Runs in the page. */
async function firstPrediction(entry) {
  const start = performance.now();
  const { init, PointerPredictor, pointerScenario, Predictor } = await import(`/dist/${entry}.js`);
  await init();
  const target = (id, x) => ({ id, x, y: 200, width: 80, height: 80 });
  const targets = [target("left", 100), target("right", 600)];
  const predictor = entry === "pointing" ? new PointerPredictor(targets) : new Predictor(pointerScenario(targets));
  predictor.observe(0, [300, 200]);
  predictor.observe(0.016, [310, 200]);
  predictor.probabilities();
  return performance.now() - start;
}

await main(import.meta.url, bench);
