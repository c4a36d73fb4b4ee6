// Tests of TypeScript beside what they test, **/*.test.ts, bundled for Node.
import { mkdtemp, readdir, rm } from "node:fs/promises";
import { tmpdir } from "node:os";
import { join } from "node:path";
import { pathToFileURL } from "node:url";
import { build } from "esbuild";
import { root } from "../scripts/run.mjs";

/** The names with a `#` are files of the built package: its one class of errors, and what `whither/dom` loads later. */
const built = {
  name: "built",
  setup({ onResolve }) {
    onResolve({ filter: /^#/ }, ({ path }) => {
      const file = join(root, "dist", `${path.slice(1)}.js`);
      return { path: pathToFileURL(file).href, external: true };
    });
  },
};

/** Runs those of a folder of the repository. */
export async function runUnits(folder) {
  const from = join(root, folder);
  const units = (await readdir(from, { recursive: true })).filter((path) => path.endsWith(".test.ts"));
  const outdir = await mkdtemp(join(tmpdir(), "whither-units-"));
  await build({
    entryPoints: units.map((path) => join(from, path)),
    outdir,
    outExtension: { ".js": ".mjs" },
    bundle: true,
    platform: "node",
    format: "esm",
    packages: "external",
    plugins: [built],
    logLevel: "warning",
  });
  for (const path of await readdir(outdir, { recursive: true })) {
    if (path.endsWith(".mjs")) await import(pathToFileURL(join(outdir, path)));
  }
  await rm(outdir, { recursive: true });
}
