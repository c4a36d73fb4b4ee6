// The programs of docs/testing.md, in a user's project.
import { test } from "node:test";
import assert from "node:assert/strict";
import { readFileSync } from "node:fs";
import { join } from "node:path";
import { capture, root } from "../../scripts/run.mjs";
import { project, strict, write } from "./support.mjs";

const text = readFileSync(join(root, "docs/testing.md"), "utf8");
const programs = [...text.matchAll(/^```ts\n(.*?)^```/gms)].map(([, program]) => program);

/** The one program that has this in it. */
function program(containing) {
  const found = programs.filter((each) => each.includes(containing));
  assert.equal(found.length, 1, containing);
  return found[0];
}

test("a test of Vitest with jsdom and fake timers passes, and fails where another link is meant", async (t) => {
  const { folder } = await project(t);
  const run = async (code) => {
    write(folder, "page.test.ts", code);
    const args = ["run", "--root", folder, "--environment", "jsdom", "--no-color"];
    return capture("node", [join(root, "node_modules/vitest/vitest.mjs"), ...args]);
  };
  const right = program('from "vitest"');
  const { code, output } = await run(right);
  assert.equal(code, 0, output);
  assert.match(output, /Tests\s+1 passed/, output);
  const wrong = right.replace("expect(intents).toEqual", "expect(intents).not.toEqual");
  assert.notEqual((await run(wrong)).code, 0);
});

test("fake timers of Node, and the same in real time, at once, in jsdom without a runner", async (t) => {
  const { folder } = await project(t);
  const code = `import { mock } from "node:test";
    import { JSDOM } from ${JSON.stringify(join(root, "node_modules/jsdom/lib/api.js"))};
    import { dispatch, hand } from "whither/testing";
    const { document } = new JSDOM("<button></button>").window;
    const button = document.querySelector("button");
    const samples = hand({ x: 0, y: 0 }, { x: 500, y: 300 }, { seed: 4 });
    const times = [];
    button.addEventListener("pointermove", (event) =>
      times.at(-1).push(...event.getCoalescedEvents().map(({ timeStamp }) => timeStamp)));
    let clicks = 0;
    button.addEventListener("click", () => (clicks += 1));
    const play = async (options) => (times.push([]), await dispatch(button, samples, { start: 100, press: true, ...options }));
    await play({});
    await play({ advanceTimers: () => {} });
    mock.timers.enable({ apis: ["setTimeout", "Date"] });
    let fired = 0;
    setTimeout(() => (fired = times.at(-1).length), 300);
    await play({ advanceTimers: (ms) => mock.timers.tick(ms) });
    const within = samples.filter(([time]) => time <= 0.3).length;
    console.log(JSON.stringify({ times, clicks, fired, within, expected: samples.slice(0, -1).map(([time]) => 100 + 1000 * time) }));`;
  write(folder, "timers.mjs", code);
  const { code: exit, output } = await capture("node", ["--no-warnings", "timers.mjs"], { cwd: folder });
  assert.equal(exit, 0, output);
  const { times, clicks, fired, within, expected } = JSON.parse(output);
  assert.deepEqual(times, [expected, expected, expected]);
  assert.equal(clicks, 3);
  // the frame that is under way when the timer fires is not dispatched yet
  assert.ok(fired <= within && fired > within - 4, `${fired} of ${within} samples before the timer`);
});

test("the declarations take the mice of Playwright, and all programs compile", async (t) => {
  const { folder } = await project(t);
  const mouse = `import type { Page } from ${JSON.stringify(join(root, "node_modules/playwright-core/index.js"))};
    import { dispatch, hand, move, random, type HandOptions, type Sample } from "whither/testing";
    const options: HandOptions = { seed: 1, size: undefined };
    export async function use(page: Page): Promise<void> {
      const box = await page.locator("a").boundingBox();
      const samples: Sample[] = hand({ x: 1, y: 2 }, box, options);
      await move(page.mouse, samples, { press: true, advanceTimers: (ms) => page.clock.runFor(ms) });
      const recorded: readonly Sample[] = [[0, 1, 2]];
      await dispatch(document, recorded, { signal: AbortSignal.timeout(9), hit: (x, y) => document.elementFromPoint(x, y) });
      await dispatch(document.body, hand(document.body.getBoundingClientRect(), { x: random(1)(), y: 0 }));
      // @ts-expect-error: a sample is [seconds, x, y]
      await move(page.mouse, [[0, 1]]);
      // @ts-expect-error: there is no such option
      hand(box, box, { speed: 2 });
    }`;
  write(folder, "mouse.ts", mouse);
  const compilerOptions = {
    ...strict,
    skipLibCheck: true,
    module: "nodenext",
    lib: ["es2022", "dom", "dom.iterable"],
    target: "es2022",
  };
  write(folder, "tsconfig.json", JSON.stringify({ compilerOptions, files: ["mouse.ts"] }));
  const { code, output } = await capture("node", [join(root, "node_modules/typescript/bin/tsc"), "--project", folder]);
  assert.equal(code, 0, output);
});
