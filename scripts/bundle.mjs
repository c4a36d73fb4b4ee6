// TypeScript of js/ and www/ in Node, without a build of its own: bundled into a temporary folder.
import { mkdtemp } from "node:fs/promises";
import { tmpdir } from "node:os";
import { join } from "node:path";
import { pathToFileURL } from "node:url";
import { build } from "esbuild";
import { root } from "./run.mjs";

/**
 * The names with a `#` are files of the built package: its one class of errors, and what `whither/dom` loads later. Packages, this one
 * too, are those that are found from here.
 */
const built = {
  name: "built",
  setup({ onResolve }) {
    onResolve({ filter: /^#/ }, ({ path }) => {
      const file = join(root, "dist", `${path.slice(1)}.js`);
      return { path: pathToFileURL(file).href, external: true };
    });
    onResolve({ filter: /^[a-z@]/ }, ({ path, kind }) =>
      kind === "entry-point" ? undefined : { path: import.meta.resolve(path), external: true },
    );
  },
};

/** Bundles files, and gives the folder with an .mjs for each; it is the caller's to remove. */
export async function bundle(entryPoints) {
  const outdir = await mkdtemp(join(tmpdir(), "whither-bundle-"));
  await build({
    entryPoints,
    outdir,
    outExtension: { ".js": ".mjs" },
    bundle: true,
    platform: "node",
    format: "esm",
    plugins: [built],
    logLevel: "warning",
  });
  return outdir;
}
