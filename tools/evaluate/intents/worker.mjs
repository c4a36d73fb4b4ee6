// Replays beside others: is given lines, `{ number, text }`, answers what came of each, in their order; or a user and the tracks,
// answers what came of each movement of the streams.
import { parentPort, workerData } from "node:worker_threads";
import { init, PointerPredictor } from "../../../dist/pointing.js";
import { judge } from "./figures.mjs";
import { SETTINGS } from "./foresight.mjs";
import { replay } from "./replay.mjs";
import { partOf, readTrack } from "./tracks.mjs";
import { chain, replayStream, SHARES } from "./wandering.mjs";

const { page, options } = workerData;
const { TestPage: Page } = await import(page);
await init();
const core = (targets, settings) => new PointerPredictor(targets, settings);

/** A movement's figures for each of the options, then for each of ForesightJS's settings; null where it has no approach. */
async function score(track) {
  const shown = await replay(track, options, { Page, core, withheld: false, peers: SETTINGS });
  if (!shown) return null;
  const hidden = await replay(track, options, { Page, core, withheld: true, peers: SETTINGS });
  return {
    user: track.user ?? "",
    part: partOf(track),
    scores: shown.intents.map((intents, i) => ({
      seconds: shown.press,
      judged: judge(shown, intents),
      withheld: hidden.intents[i].filter(({ begin }) => begin < hidden.press).length,
    })),
  };
}

async function scoreLines(lines) {
  const scored = [];
  for (const { number, text } of lines) {
    try {
      scored.push(await score(readTrack(text)));
    } catch (error) {
      scored.push({ broken: `${number}: ${error.message}` });
    }
  }
  return scored;
}

async function scoreStreams({ user, tracks }) {
  const movements = chain(tracks, user);
  const streams = [];
  for (const share of SHARES) streams.push(await replayStream(movements, share, options, { Page, core }));
  return streams;
}

parentPort.on("message", async (job) => {
  parentPort.postMessage(await (Array.isArray(job) ? scoreLines(job) : scoreStreams(job)));
});
