// The packed package with what is too large to be installed with the rest: Next, by both of its bundlers, Bun, Deno, and test runners.
import { test } from "node:test";
import assert from "node:assert/strict";
import { spawn } from "node:child_process";
import { once } from "node:events";
import { cpSync, mkdirSync, readFileSync } from "node:fs";
import { join } from "node:path";
import { createInterface } from "node:readline";
import { launch } from "../../scripts/chromium.mjs";
import { incremental } from "../../scripts/incremental.mjs";
import { capture, root, run } from "../../scripts/run.mjs";
import { movement } from "../browser/hand.mjs";
import { mouse, REST } from "../browser/support.mjs";
import { install, inTab, write } from "../package/support.mjs";
import { assertEager, assertWatched, watching } from "../package/watched.mjs";
import { testRunners } from "./testing.mjs";

/** A project with what package.json beside this file names, which stays from run to run. */
const folder = join(root, "target/elsewhere");
const names = ["package.json", "package-lock.json"];
const from = "tests/elsewhere";
const places = { inputs: names.map((name) => `${from}/${name}`), outputs: ["target/elsewhere/node_modules/next"] };
await incremental("elsewhere", { ...places, doing: `installing what ${from}/package.json names` }, async () => {
  mkdirSync(folder, { recursive: true });
  for (const name of names) cpSync(join(root, from, name), join(folder, name));
  await run("npm", ["ci", "--no-audit", "--no-fund", "--loglevel=error"], { cwd: folder });
});
await install(folder);

const onServer = `import { watch } from "whither/dom";
import { init, PointerPredictor } from "whither/pointing";
const { best, none, targets } = watch("a", { load: "eager" });
await init();
const predictor = new PointerPredictor([100, 500, 900].map((x) => ({ id: String(x), x, y: 100, width: 80, height: 80 })));
for (let k = 0; k < 12; k++) predictor.observe(k / 60, [480 + k * k, 600 - 20 * k]);
console.log(JSON.stringify({ best, none, targets, predicted: predictor.best.id }));
`;

/** The arguments of each; Deno with no permission at all. */
const runtimes = { bun: [], deno: ["run", "--no-prompt"] };

test("whither/dom does nothing on a server, and whither/pointing predicts", async (t) => {
  write(folder, "server.mjs", onServer);
  for (const [name, args] of Object.entries(runtimes)) {
    await t.test(`in ${name}`, async () => {
      const { code, output } = await capture(join(folder, "node_modules/.bin", name), [...args, "server.mjs"], { cwd: folder });
      assert.equal(code, 0, output);
      assert.deepEqual(JSON.parse(output), { best: null, none: 1, targets: [], predicted: "900" });
    });
  }
});

const layout = `import { createElement } from "react";
export default ({ children }) => createElement("html", { lang: "en" },
  createElement("head", null, createElement("link", { rel: "icon", href: "data:," })), createElement("body", null, children));
`;

const page = `import { createElement } from "react";
import { Watched } from "./watched.js";
export default () => createElement(Watched);
`;

/** It is rendered on the server too, where \`watch\` is called for nothing. */
const component = `"use client";
import { createElement, useEffect } from "react";
import { watch } from "whither/dom";
const { none } = watch("a");
export function Watched() {
  useEffect(() => {
    ${watching}
    return () => window.watcher.stop();
  }, []);
  return createElement("p", null, none);
}
`;

/** What docs/react.md has for Next: its provider and a plain element in components of the server, and a link of Next's own. */
const [, intentLink] = readFileSync(join(root, "docs/react.md"), "utf8").match(/```jsx\n\/\/ app\/intent-link\.jsx\n(.*?)```/s);

const harbour = {
  "app/intent-link.jsx": intentLink,
  "app/harbour/layout.jsx": `import { IntentProvider } from "whither/react";
export default ({ children }) => <IntentProvider load="eager">{children}</IntentProvider>;
`,
  "app/harbour/page.jsx": `import { Intent } from "whither/react";
import { IntentLink } from "../intent-link.jsx";
const at = (left) => ({ position: "absolute", left, top: 100, width: 90, height: 40 });
export default () => <>
  <Intent id="left" href="#left" style={at(100)}>left</Intent>
  <IntentLink id="right" href="/ports" style={at(900)}>right</IntentLink>
</>;
`,
  "app/ports/page.jsx": "export default () => <h1>Ports</h1>;\n",
};

/** Next's own link is prefetched when the mouse is on its way to it, before it is there, and not before that. */
async function assertLinked(browser, url) {
  await inTab(browser, async (tab) => {
    const prefetched = [];
    tab.on("request", (request) => new URL(request.url()).pathname.startsWith("/ports") && prefetched.push(request.url()));
    await tab.setViewportSize({ width: 1280, height: 800 });
    await tab.goto(`${url}/harbour`);
    await tab.waitForLoadState("networkidle");
    const hand = await mouse(tab);
    const [from, to] = [
      { x: 300, y: 700 },
      { x: 945, y: 120 },
    ];
    await hand.play([[0, from.x, from.y]]);
    await hand.rest(REST);
    assert.deepEqual(prefetched, []);
    const way = movement(from, to, 40, { seed: 3 });
    const isOver = ([, x, y]) => x > 890 && x < 1000 && y > 90 && y < 150;
    await hand.play(way.slice(0, way.findIndex(isOver)));
    await tab.waitForSelector("#right[data-predicted]");
    assert.equal(await tab.locator("#right:hover").count(), 0, "the mouse is not there yet");
    await tab.waitForLoadState("networkidle");
    assert.ok(prefetched.length > 0, "it is prefetched");
    await tab.locator("#right").click();
    await tab.waitForSelector("h1");
    assert.equal(await tab.locator("[data-predicted]").count(), 0);
  });
}

test("whither/dom and whither/react in Next's app router", async (t) => {
  write(folder, "app/layout.js", layout);
  write(folder, "app/page.js", page);
  write(folder, "app/watched.js", component);
  for (const [name, text] of Object.entries(harbour)) write(folder, name, text);
  const browser = await launch();
  t.after(() => browser.close());
  const next = "node_modules/next/dist/bin/next";
  const env = { NEXT_TELEMETRY_DISABLED: "1" };
  for (const bundler of ["turbopack", "webpack"]) {
    await t.test(
      `by ${bundler}: the core is a file of its own that comes later, and a link of Next is prefetched when it is meant`,
      async (t) => {
        const { code, output } = await capture("node", [next, "build", `--${bundler}`], { cwd: folder, env });
        assert.equal(code, 0, output);
        const host = spawn("node", [next, "start", "--port", "0"], { cwd: folder, env: { ...process.env, ...env } });
        const ended = once(host, "exit");
        t.after(() => {
          host.kill();
          return ended;
        });
        let url;
        for await (const line of createInterface({ input: host.stdout })) {
          url ??= line.match(/http:\/\/localhost:\d+/)?.[0];
          if (line.includes("Ready")) break;
        }
        assert.ok(url, "Next has not started");
        await assertWatched(browser, `${url}/`);
        await assertEager(browser, `${url}/`);
        await assertLinked(browser, url);
      },
    );
  }
});

testRunners(folder);
