/** A service worker that keeps the built pages: they work offline once one of them has been visited. */
import { createHash } from "node:crypto";
import { readdirSync } from "node:fs";
import { readFile, writeFile } from "node:fs/promises";
import { join } from "node:path";

/** A plugin of Vite: writes `offline.js` beside the pages, with the list of what was built. */
export function offline() {
  let folder = "";
  return {
    name: "offline",
    apply: "build",
    configResolved({ build }) {
      folder = build.outDir;
    },
    async closeBundle() {
      const files = readdirSync(folder, { recursive: true, withFileTypes: true })
        .filter((entry) => entry.isFile())
        .map((entry) => join(entry.parentPath, entry.name).slice(folder.length + 1))
        .filter((file) => file !== "offline.js")
        .sort();
      const hash = createHash("sha256");
      for (const file of files) hash.update(file).update(await readFile(join(folder, file)));
      const version = hash.digest("hex").slice(0, 16);
      const constants = `const CACHE = "whither-${version}";\nconst FILES = ${JSON.stringify(files)};\n`;
      await writeFile(join(folder, "offline.js"), `${constants}(${worker})(CACHE, FILES);\n`);
    },
  };
}

/** Runs as the service worker. What has a hash in its name never changes; of all else the newest is taken, where there is a network. */
function worker(name, files) {
  const here = new URL("./", self.location.href);
  self.addEventListener("install", (event) => {
    event.waitUntil(caches.open(name).then((cache) => cache.addAll(files.map((file) => new URL(file, here).href))));
  });
  self.addEventListener("activate", (event) => {
    const old = async () => {
      const names = (await caches.keys()).filter((other) => other.startsWith("whither-") && other !== name);
      await Promise.all(names.map((other) => caches.delete(other)));
    };
    event.waitUntil(old());
  });
  self.addEventListener("fetch", (event) => {
    const address = new URL(event.request.url);
    if (event.request.method !== "GET" || !address.href.startsWith(here.href)) return;
    const file = address.pathname.endsWith("/") ? `${address.origin}${address.pathname}index.html` : event.request;
    const kept = async () => (await caches.open(name)).match(file, { ignoreSearch: true });
    const answer = async () => {
      if (address.pathname.includes("/assets/")) return (await kept()) ?? fetch(event.request);
      return fetch(event.request).catch(async (error) => {
        const found = await kept();
        if (found) return found;
        throw error;
      });
    };
    event.respondWith(answer());
  });
}
