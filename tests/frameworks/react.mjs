// What the tests of whither/react share: pages with React 18 and with React 19, on which each call to whither/dom is counted.
import assert from "node:assert/strict";
import { before, describe } from "node:test";
import { join } from "node:path";
import { root } from "../../scripts/run.mjs";
import { bundle, hosted, open as openPage, reactAliases } from "./support.mjs";

/** In place of `whither/dom`: the same, with what is called kept in `watchers`. */
const counting = {
  name: "counting",
  setup({ onResolve, onLoad }) {
    const real = join(root, "dist/dom.js");
    onResolve({ filter: /^\.\/dom\.js$/ }, ({ importer }) =>
      importer.endsWith("react.js") ? { path: real, namespace: "counted" } : null,
    );
    onLoad({ filter: /./, namespace: "counted" }, () => ({
      resolveDir: join(root, "dist"),
      contents: `import { watch as begin } from "./dom.js";
        export * from "./dom.js";
        window.watchers = [];
        export function watch(...given) {
          const watcher = begin(...given);
          const calls = [];
          for (const name of ["add", "remove", "update", "set", "stop"]) {
            const own = watcher[name].bind(watcher);
            watcher[name] = (...given) => (calls.push([name, name === "update" ? Object.keys(given[0]) : given.length]), own(...given));
          }
          window.watchers.push({ watcher, calls });
          return watcher;
        }`,
    }));
  },
};

/** The calls of all watchers, `[["add", 3], ["update", ["threshold"]], ...]`: with how many nodes, or which options, they were about. */
export const calls = (page) => page.evaluate(() => watchers.map(({ calls }) => calls));

/** The ids of what the one watcher that there is watches. */
export const watched = (page) => page.evaluate(() => watchers.at(-1).watcher.targets.map(({ id }) => id));

/** What was logged, or of it what is about one target: where a hand rests before it moves, that is meant, too. */
export const logOf = (page, id) => page.evaluate((id) => log.filter(({ target }) => id === undefined || target === id), id);

/** Until something holds in the page. */
export const until = (page, condition, argument) => page.waitForFunction(condition, argument, { timeout: 5000 });

/** Registers tests for each version: `open(t)` opens a page with `react-kit.mjs`, in `site`. */
export function eachReact(register) {
  describe("whither/react", { concurrency: 2 }, () => {
    for (const version of [18, 19]) {
      describe(`React ${version}`, () => {
        const site = hosted();
        let files;
        before(async () => {
          const kit = join(root, "tests/frameworks/react-kit.mjs");
          files = await bundle(kit, { alias: reactAliases(version), plugins: [counting] });
        });
        const open = async (t) => {
          const opened = await openPage(t, site, files);
          await opened.page.waitForFunction(() => window.isReady);
          assert.equal(await opened.page.evaluate(() => kit.version.split(".")[0]), String(version));
          return opened;
        };
        register({ version, site, open });
      });
    }
  });
}
