// The page's own logic, bundled for Node: www/**/*.test.ts.
import { mkdtemp, readdir, rm } from "node:fs/promises";
import { tmpdir } from "node:os";
import { join } from "node:path";
import { fileURLToPath, pathToFileURL } from "node:url";
import { build } from "esbuild";

const www = fileURLToPath(new URL("../../www/", import.meta.url));
const units = (await readdir(www, { recursive: true })).filter((path) => path.endsWith(".test.ts"));
const outdir = await mkdtemp(join(tmpdir(), "whither-units-"));
await build({
  entryPoints: units.map((path) => join(www, path)),
  outdir,
  outExtension: { ".js": ".mjs" },
  bundle: true,
  platform: "node",
  format: "esm",
  packages: "external",
  logLevel: "warning",
});
for (const path of await readdir(outdir, { recursive: true })) {
  if (path.endsWith(".mjs")) await import(pathToFileURL(join(outdir, path)));
}
await rm(outdir, { recursive: true });
