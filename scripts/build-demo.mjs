// `npm run build:demo`: www/dist/, the pages for any static host and any sub-path; beside them the package, packed, and the documentation.
import { readFile, rename } from "node:fs/promises";
import { join } from "node:path";
import { build } from "./build.mjs";
import { incremental } from "./incremental.mjs";
import { capture, Failure, main, root, run } from "./run.mjs";

export const folder = join(root, "www/dist");

export async function buildDemo() {
  await build();
  const packed = ["dist", "docs", "examples", "package.json", "README.md", "CHANGELOG.md", "ARCHITECTURE.md"];
  const inputs = [...packed, "www", "package-lock.json", "scripts/build-demo.mjs", "scripts/size.mjs"];
  await incremental("demo", { inputs, ignore: "www/dist", outputs: ["www/dist/index.html"] }, async () => {
    await run("node", ["node_modules/typescript/bin/tsc", "--project", "www"]);
    const vite = await import("vite");
    await vite.build({ configFile: join(root, "www/vite.config.js") });
    await pack();
  });
}

/** The documents, and the interface from the comments in js/, beside the demo. A warning is an error. */
export async function buildDocs() {
  const inputs = ["docs", "js", "typedoc.json", "scripts/documents.mjs", "scripts/docs.css", "examples", "package-lock.json"];
  await incremental("documentation", { inputs, outputs: ["www/dist/docs/index.html"] }, async () => {
    const { code, output } = await capture("node", ["node_modules/typedoc/bin/typedoc", "--options", "typedoc.json"]);
    if (code !== 0) throw new Failure(output);
  });
}

/** What `npm install` takes from beside the pages. */
async function pack() {
  const { version } = JSON.parse(await readFile(join(root, "package.json"), "utf8"));
  const { code, output } = await capture("npm", ["pack", "--ignore-scripts", "--silent", "--pack-destination", folder]);
  if (code !== 0) throw new Failure(`npm pack failed: ${output}`);
  await rename(join(folder, `whither-${version}.tgz`), join(folder, "whither.tgz"));
}

await main(import.meta.url, async () => {
  await buildDemo();
  await buildDocs();
});
