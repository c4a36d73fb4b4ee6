/** How the pages are built and, for `npm run dev`, served. */
import { readFileSync } from "node:fs";
import { appendFile } from "node:fs/promises";
import { fileURLToPath } from "node:url";
import { defineConfig } from "vite";
import { sizes } from "../scripts/size.mjs";
import { frame, PAGES } from "./frame.js";
import { offline } from "./offline.js";

const here = (path) => fileURLToPath(new URL(path, import.meta.url));

/** Packages that are bundled where Vite's list of licences does not look: in workers and in styles. */
const ALSO = ["js.foresight", "@fontsource-variable/archivo"];

/** A plugin of Vite: adds their notices. */
function notices() {
  return {
    name: "notices",
    apply: "build",
    async closeBundle() {
      for (const name of ALSO) {
        const { version, license } = JSON.parse(readFileSync(here(`../node_modules/${name}/package.json`), "utf8"));
        const text = readFileSync(here(`../node_modules/${name}/LICENSE`), "utf8");
        await appendFile(here("dist/licences.md"), `\n\n## ${name} - ${version} (${license})\n\n${text}`);
      }
    },
  };
}

export default defineConfig(() => {
  const { version, license, homepage: repository } = JSON.parse(readFileSync(here("../package.json"), "utf8"));
  const gzipped = (name) => sizes().find((part) => part.name.startsWith(name)).gzip;
  return {
    root: here("."),
    base: "./",
    logLevel: "warn",
    plugins: [frame({ version, license, repository }), notices(), offline()],
    define: {
      __WHITHER__: {
        version,
        license,
        repository: repository ?? null,
        // bytes under gzip
        dom: gzipped("`whither/dom`"),
        later: gzipped("`whither/pointing`") + gzipped("what it loads when a pointer moves"),
      },
    },
    build: {
      outDir: here("dist"),
      emptyOutDir: true,
      target: "es2022",
      // the notices of what is bundled, as their licences ask for
      license: { fileName: "licences.md" },
      rollupOptions: { input: PAGES.map(({ path }) => here(path)) },
    },
    worker: { format: "es" },
  };
});
