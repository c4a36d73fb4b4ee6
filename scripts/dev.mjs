// `npm run dev`: the page, served from its sources by Vite; the package is rebuilt without the slow steps whenever Rust or
// TypeScript changes, and the page reloaded.
import { watch } from "node:fs";
import { join } from "node:path";
import { build } from "./build.mjs";
import { Failure, main, root } from "./run.mjs";
import { wantedPort } from "./serve.mjs";

/** What the package is made of. */
const sources = [
  "src",
  "kernel",
  "js/core",
  "js/dom",
  "js/entries",
  "js/pointing",
  "js/study",
  "js/links",
  "js/testing",
  "Cargo.toml",
];

/** Milliseconds without a change before a build: an editor writes a file in several steps. */
const QUIET = 100;

await main(import.meta.url, async () => {
  const port = wantedPort();
  await build({ dev: true });
  const { createServer } = await import("vite");
  const server = await createServer({
    configFile: join(root, "www/vite.config.js"),
    // the package as it is, not a copy in Vite's own cache
    optimizeDeps: { exclude: ["whither"] },
    server: { port, strictPort: true, fs: { allow: [root] }, watch: { ignored: [join(root, "dist/**")] } },
  });
  await server.listen();
  console.log(`\nThe page is at ${server.resolvedUrls.local[0]} (Ctrl+C stops it)`);
  console.log("A change in www/ is there at once; one in src/ or js/ rebuilds the package and reloads the page.");
  rebuild(server);
});

function rebuild(server) {
  let timer;
  let building = Promise.resolve();
  const begin = () => {
    building = building.then(async () => {
      const start = Date.now();
      try {
        await build({ dev: true });
        server.moduleGraph.invalidateAll();
        server.ws.send({ type: "full-reload" });
        console.log(`Rebuilt in ${((Date.now() - start) / 1000).toFixed(1)} s`);
      } catch (error) {
        console.error(error instanceof Failure ? error.message : error);
      }
    });
  };
  for (const path of sources) {
    watch(join(root, path), { recursive: true }, () => {
      clearTimeout(timer);
      timer = setTimeout(begin, QUIET);
    });
  }
}
