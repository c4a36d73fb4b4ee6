// Literal Algorithm 1 in numpy and in ours: how long it takes, and whether the answers agree.
import { writeFileSync } from "node:fs";
import { join } from "node:path";
import { answer, root, run } from "../scripts/run.mjs";
import { during } from "../scripts/stage.mjs";
import { INTERVAL, scenario, sweep } from "./scenarios.mjs";

/** A Python with numpy; null where there is none. */
async function find() {
  const places = [process.env.PYTHON, "python3", "/usr/bin/python3", "python"];
  for (const python of places.filter((place) => place)) {
    if ((await answer(python, ["-c", "import numpy"])) !== null) return python;
  }
  return null;
}

/** Installs it where that can be done without asking: as root on Debian and its kin. */
async function findOrInstall() {
  const found = await find();
  if (found !== null || process.getuid?.() !== 0 || (await answer("apt-get", ["--version"])) === null) return found;
  const env = { DEBIAN_FRONTEND: "noninteractive" };
  try {
    await during("installing numpy", async () => {
      await run("apt-get", ["update", "--quiet", "--quiet"], { env });
      await run("apt-get", ["install", "--yes", "--quiet", "--quiet", "--no-install-recommends", "python3-numpy"], { env });
    });
  } catch {
    return null; // the table reports that it is missing
  }
  return find();
}

/** `{ numpy, microseconds, difference }`, the last being the largest between our probabilities and theirs; null without numpy. */
export async function measureNumpy({ Predictor }, one, folder) {
  const python = await findOrInstall();
  if (python === null) return null;
  console.log("numpy: literal Algorithm 1");
  const given = scenario(one);
  const observations = sweep.slice(0, 12).map(([x, y], k) => [INTERVAL * k, x, y]);
  const file = join(folder, "algorithm1.json");
  writeFileSync(file, JSON.stringify({ scenario: given, observations }));
  const { numpy, seconds, probabilities } = JSON.parse(await answer(python, [join(root, "benches/algorithm1.py"), file]));
  const predictor = new Predictor(given);
  for (const [t, ...position] of observations) predictor.observe(t, position);
  const difference = Math.max(...predictor.probabilities().map((p, i) => Math.abs(p - probabilities[i])));
  predictor.free();
  return { numpy, microseconds: 1e6 * seconds, difference };
}
