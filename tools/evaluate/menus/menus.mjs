// `npm run evaluate -- --menus FILE...`: what holding a submenu open is worth, by whither/menu, floating-ui's safePolygon and delays, on menus laid
// around recorded movements and around simulated ones.
import { rm } from "node:fs/promises";
import { join } from "node:path";
import { pathToFileURL } from "node:url";
import { parseArgs } from "node:util";
import { init, PointerPredictor } from "../../../dist/pointing.js";
import { bundle } from "../../../scripts/bundle.mjs";
import { Failure, main, root } from "../../../scripts/run.mjs";
import { randomOf } from "../intents/random.mjs";
import { writeJson } from "../intents/report.mjs";
import { nameOf, partOf, readLines, readTrack } from "../intents/tracks.mjs";
import { judge } from "./figures.mjs";
import { methodsOf, replay } from "./methods.mjs";
import { figuresOf, LEGEND, printSet, printShapes } from "./report.mjs";
import { KINDS, sceneOf } from "./scenes.mjs";
import { simulated } from "./simulated.mjs";

await main(import.meta.url, async () => {
  const { values, positionals } = parseArgs({
    allowPositionals: true,
    options: { tuned: { type: "boolean", default: false }, json: { type: "string" } },
  });
  const bundled = await bundle(
    ["dom/testing/page.ts", "menu/held-open.ts", "menu/handle-close.ts"].map((file) => join(root, "js", file)),
  );
  const load = (file) => import(pathToFileURL(join(bundled, file)).href);
  try {
    const { TestPage: Page } = await load("dom/testing/page.mjs");
    const methods = await methodsOf(
      { ...(await load("menu/held-open.mjs")), ...(await load("menu/handle-close.mjs")) },
      values.tuned,
    );
    await init();
    await score(positionals, values, methods, { Page, core: (targets, options) => new PointerPredictor(targets, options) });
  } finally {
    await rm(bundled, { recursive: true });
  }
});

async function score(files, { tuned, json }, methods, page) {
  const sets = new Map();
  for (const file of files) {
    for (const track of await tracksOf(file, tuned)) {
      const name = nameOf(file) + partOf(track);
      sets.set(name, [...(sets.get(name) ?? []), track]);
    }
  }
  if (sets.size === 0) throw new Failure("nothing to score: no track is of a user of this half");
  sets.set(
    "simulated",
    simulated().filter((track) => isTuned(track) === tuned),
  );
  console.log(LEGEND);
  const all = [];
  for (const [name, tracks] of sets) {
    const scenes = tracks.flatMap((track) => KINDS.map((kind) => sceneOf(track, kind)).filter(Boolean));
    const scored = [];
    for (const scene of scenes) {
      for (const [method, hold] of Object.entries(methods)) {
        scored.push({ set: name, method, scene, judged: judge(scene, await replay(scene, hold, page)) });
      }
    }
    printSet(name, scored);
    all.push(...scored);
  }
  printShapes(all);
  if (json) await writeJson(json, { menus: figuresOf(all) });
}

/** The tracks of one half of the users. */
async function tracksOf(file, tuned) {
  return (await readLines(file)).flatMap(({ number, text }) => {
    try {
      const track = readTrack(text);
      return isTuned(track) === tuned ? [track] : [];
    } catch (error) {
      console.error(`${file}:${number}: ${error.message}; skipped`);
      return [];
    }
  });
}

/** Whether a track's user is of the half on which constants were tuned. */
function isTuned({ user }) {
  return randomOf(`half ${user}`)() < 0.5;
}
