// `npm run build:demo`: www/dist/, the page for any static host and any sub-path.
import { join } from "node:path";
import { build } from "./build.mjs";
import { incremental } from "./incremental.mjs";
import { main, root, run } from "./run.mjs";

export const folder = join(root, "www/dist");

export async function buildDemo() {
  await build();
  const inputs = ["dist", "www", "package-lock.json", "scripts/build-demo.mjs"];
  await incremental("demo", { inputs, ignore: "www/dist", outputs: ["www/dist/index.html"] }, async () => {
    await run("node", ["node_modules/typescript/bin/tsc", "--project", "www"]);
    const vite = await import("vite");
    await vite.build({
      root: join(root, "www"),
      configFile: false,
      base: "./",
      logLevel: "warn",
      build: {
        outDir: folder,
        emptyOutDir: true,
        target: "es2022",
        rollupOptions: { input: ["index.html", "sequences/index.html"].map((page) => join(root, "www", page)) },
      },
    });
  });
}

await main(import.meta.url, buildDemo);
