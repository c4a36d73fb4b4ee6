// Tests of TypeScript beside what they test, **/*.test.ts, bundled for Node.
import { readdir, rm } from "node:fs/promises";
import { join } from "node:path";
import { pathToFileURL } from "node:url";
import { bundle } from "../scripts/bundle.mjs";
import { root } from "../scripts/run.mjs";

/** Runs those of a folder of the repository. */
export async function runUnits(folder) {
  const from = join(root, folder);
  const units = (await readdir(from, { recursive: true })).filter((path) => path.endsWith(".test.ts"));
  const outdir = await bundle(units.map((path) => join(from, path)));
  for (const path of await readdir(outdir, { recursive: true })) {
    if (path.endsWith(".mjs")) await import(pathToFileURL(join(outdir, path)));
  }
  await rm(outdir, { recursive: true });
}
