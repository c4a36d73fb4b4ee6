// Work that is done only when what it depends on has changed.
import { createHash } from "node:crypto";
import { existsSync, mkdirSync, readFileSync, readdirSync, statSync, writeFileSync } from "node:fs";
import { join } from "node:path";
import { root } from "./run.mjs";
import { during } from "./stage.mjs";

/**
 * Does `work` unless it was done before with the same `inputs` (files and folders, by their content) and its `outputs` are
 * still there. Paths are relative to the repository; what is in `ignore` does not count. Of several variants the outputs hold one:
 * another has to be done again. `doing` is printed while it is done, unless that is null: then `work` prints its own stages.
 */
export async function incremental(name, { inputs, ignore = null, outputs, variant = "", doing = `building ${name}` }, work) {
  const stamp = join(root, "target/stamps", name);
  const now = contentHash(inputs, ignore) + variant;
  const done = existsSync(stamp) && readFileSync(stamp, "utf8") === now;
  if (done && outputs.every((output) => existsSync(join(root, output)))) return;
  await (doing === null ? work() : during(doing, work));
  mkdirSync(join(stamp, ".."), { recursive: true });
  writeFileSync(stamp, now);
}

function contentHash(inputs, ignore) {
  const hash = createHash("sha256");
  const add = (path) => {
    if (path === ignore) return;
    const absolute = join(root, path);
    if (statSync(absolute).isDirectory()) {
      for (const entry of readdirSync(absolute).sort()) add(`${path}/${entry}`);
    } else {
      hash.update(`${path}\0`).update(readFileSync(absolute)).update("\0");
    }
  };
  inputs.forEach(add);
  return hash.digest("hex");
}
