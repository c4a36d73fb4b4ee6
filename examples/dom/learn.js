// Learns in a thread of its own: takes the lines of a ledger, gives back constants and what they gain on presses left out.
import { init, pointerScenario } from "../../dist/index.js";
import { fit } from "../../dist/study.js";

addEventListener("message", async ({ data: lines }) => {
  try {
    await init();
    const somewhere = [{ id: "any", x: 0, y: 0, width: 1, height: 1 }]; // the lines have targets of their own
    const progress = ({ share }) => postMessage({ share });
    const tracks = lines.map((line) => JSON.parse(line));
    const { scenario, leftOut } = await fit(tracks, pointerScenario(somewhere, { none: 0.05 }), { progress });
    postMessage({ constants: scenario, leftOut });
  } catch (error) {
    postMessage({ error: error.message });
  }
});
