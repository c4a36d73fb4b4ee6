/** How the pages are built and, for `npm run dev`, served. */
import { readFileSync } from "node:fs";
import { fileURLToPath } from "node:url";
import { defineConfig } from "vite";
import { sizes } from "../scripts/size.mjs";
import { frame, PAGES } from "./frame.js";
import { offline } from "./offline.js";

const here = (path) => fileURLToPath(new URL(path, import.meta.url));

export default defineConfig(() => {
  const { version, license, repository } = JSON.parse(readFileSync(here("../package.json"), "utf8"));
  const gzipped = (name) => sizes().find((part) => part.name.startsWith(name)).gzip;
  return {
    root: here("."),
    base: "./",
    logLevel: "warn",
    plugins: [frame({ version, license, repository: repository?.url }), offline()],
    define: {
      __WHITHER__: {
        version,
        license,
        repository: repository?.url ?? null,
        // bytes under gzip
        dom: gzipped("`whither/dom`"),
        pointing: gzipped("`whither/pointing`"),
      },
    },
    build: {
      outDir: here("dist"),
      emptyOutDir: true,
      target: "es2022",
      rollupOptions: { input: PAGES.map(({ path }) => here(path)) },
    },
    worker: { format: "es" },
  };
});
