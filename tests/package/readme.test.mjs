// The code of the README and of the pages where it goes on, followed to the letter: compiled by strict TypeScript, run in Node, and on pages over which the real mouse
// moves.
import { after, before, describe, it, test } from "node:test";
import assert from "node:assert/strict";
import { cpSync, readFileSync, symlinkSync } from "node:fs";
import { basename, join } from "node:path";
import * as esbuild from "esbuild";
import { launch } from "../../scripts/chromium.mjs";
import { capture, root } from "../../scripts/run.mjs";
import { serve } from "../../scripts/serve.mjs";
import { movement } from "../browser/hand.mjs";
import { mouse, nextFrame, REST } from "../browser/support.mjs";
import { project, strict, write } from "./support.mjs";

const readme = readFileSync(join(root, "README.md"), "utf8");
const blocks = (language, name = "README.md") =>
  [...readFileSync(join(root, name), "utf8").matchAll(new RegExp(`^\`\`\`${language}\n(.*?)^\`\`\``, "gms"))].map(
    ([, code]) => code,
  );
const [watching, onAPage, inNode, projecting, learning, ...rest] = [
  "README.md",
  "docs/drawing.md",
  "docs/scenarios.md",
  "docs/learning.md",
].flatMap((name) => blocks("js", name));

test("the README's code", async (t) => {
  const { folder, tarball } = await project(t);

  await t.test("there are five programs", () => assert.deepEqual([learning !== undefined, rest.length], [true, 0]));

  await t.test("names the file that is installed until the package is on npm", () => {
    const [commands] = blocks("sh");
    assert.match(commands, new RegExp(`npm pack .*: builds ${basename(tarball)}\nnpm install PATH/TO/${basename(tarball)} `));
    assert.match(readme, /on no registry yet/);
  });

  const projects = {
    "strict and no more": {},
    "with the fewest libraries": { lib: ["ES2022", "DOM"] },
    "with every check": {
      noUncheckedIndexedAccess: true,
      noImplicitReturns: true,
      noUnusedLocals: true,
      noUnusedParameters: true,
    },
  };
  for (const [name, more] of Object.entries(projects)) {
    await t.test(`on a page compiles as it is pasted into a strict TypeScript project, ${name}`, async () => {
      write(folder, "watching.ts", watching);
      write(folder, "pasted.ts", onAPage);
      const compilerOptions = { ...strict, target: "ES2022", module: "esnext", moduleResolution: "bundler", ...more };
      write(folder, "tsconfig.json", JSON.stringify({ compilerOptions, files: ["watching.ts", "pasted.ts"] }));
      const { code, output } = await capture("node", [join(root, "node_modules/typescript/bin/tsc")], { cwd: folder });
      assert.equal(code, 0, output);
    });
  }

  // the other package that the README names
  symlinkSync(join(root, "node_modules/proj4"), join(folder, "node_modules/proj4"), "junction");
  for (const [name, program] of Object.entries({ inNode, projecting, learning })) {
    await t.test(`in Node prints what its comments state: ${name}`, async () => {
      write(folder, `${name}.mjs`, program);
      const { code, output } = await capture("node", [`${name}.mjs`], { cwd: folder });
      assert.equal(code, 0, output);
      const promised = [...program.matchAll(/^console\.log\(.*\); \/\/ (.*)$/gm)].map(([, comment]) => comment);
      assert.ok(promised.length > 1);
      assert.deepEqual(output.trim().split("\n"), promised);
    });
  }

  await t.test("in Rust is a program as it is pasted, with those dependencies", async () => {
    const [dependencies] = blocks("toml");
    const [program] = blocks("rust");
    const rust = join(folder, "in-rust");
    write(rust, "Cargo.toml", `[package]\nname = "pasted"\nedition = "2024"\n\n${dependencies.replace("PATH/TO/whither", root)}`);
    write(rust, "src/main.rs", program);
    // the versions that this project has already
    cpSync(join(root, "Cargo.lock"), join(rust, "Cargo.lock"));
    const args = ["run", "--quiet", "--offline", "--target-dir", join(root, "target/readme")];
    const { code, output } = await capture("cargo", args, { cwd: rust });
    assert.equal(code, 0, output);
    assert.equal(output.trim(), program.match(/println!.*; \/\/ (.*)/)[1]);
  });

  await t.test("watches a page's elements: calls back before the mouse is there, and when it turns away", (t) =>
    watches(t, folder),
  );

  await t.test("on a page", () => onPages(folder));
});

async function watches(t, folder) {
  const buttons = ["Radio", "Map"].map((name, i) => `<button style="left:${100 + 700 * i}px">${name}</button>`).join("");
  const style = "button { position: fixed; top: 300px; width: 96px; height: 96px }";
  const head = `<!doctype html><link rel="icon" href="data:,"><style>${style}</style>`;
  write(folder, "watched/index.html", `${head}${buttons}<script type="module" src="watching.js"></script>`);
  write(folder, "watching.js", watching);
  const bundle = { bundle: true, splitting: true, format: "esm", outdir: "watched", logLevel: "warning" };
  await esbuild.build({ absWorkingDir: folder, entryPoints: ["watching.js"], ...bundle });
  const server = await serve(join(folder, "watched"));
  const browser = await launch();
  t.after(() => Promise.all([browser.close(), server.close()]));
  const tab = await browser.newPage();
  const logged = [];
  tab.on("console", (message) => logged.push(message.text()));
  tab.on("pageerror", (error) => logged.push(String(error)));
  await tab.goto(server.url);
  const hand = await mouse(tab);
  const from = { x: 300, y: 600 };
  const to = { x: 848, y: 348 };
  await hand.play([[0, from.x, from.y]]);
  await hand.rest(REST);
  await hand.play(movement(from, to, 96, { seed: 2, share: 0.75 }));
  await nextFrame(tab);
  assert.equal(await tab.evaluate(() => document.querySelector("button:hover")), null);
  assert.match(logged.join("\n"), /^Map 0\.\d+$/);
  await hand.play(movement({ x: 760, y: 380 }, { x: 600, y: 60 }, 96, { seed: 3 }).slice(8));
  await nextFrame(tab);
  assert.match(logged.join("\n"), /^Map 0\.\d+\nnot Map$/);
}

/** Four icons in a row, and a hidden one. */
const icons = [0, 1, 2, 3].map((i) => `<i data-icon id="icon${i}" style="left:${100 + 300 * i}px"></i>`).join("");
const page = `<!doctype html><link rel="icon" href="data:,"><style>
  [data-icon] { position: fixed; top: 300px; width: 96px; height: 96px }
</style>${icons}<i data-icon id="hidden" style="display:none"></i><script type="module" src="main.js"></script>`;

/** The package, whose last answer can be read in the page, and replaced. */
const heard = `import { PointerPredictor as Original } from "whither/pointing";
export { init } from "whither/pointing";
export class PointerPredictor extends Original {
  get best() {
    return (window.best = window.instead ?? super.best);
  }
}`;

/** Half-way between the first two icons, below them; and the middle of the last. */
const start = [300, 600];
const last = [1048, 348];

async function onPages(folder) {
  write(folder, "site/index.html", page);
  write(folder, "main.js", onAPage.replace(/from "whither\/pointing"/, 'from "./heard.js"'));
  write(folder, "heard.js", heard);
  const bundle = { bundle: true, format: "esm", target: "es2022", outdir: "site", logLevel: "warning" };
  await esbuild.build({ absWorkingDir: folder, entryPoints: ["main.js"], ...bundle });

  await describe("from whither/pointing", () => {
    let server, browser, tab, errors;

    before(async () => {
      server = await serve(join(folder, "site"));
      browser = await launch();
    });
    after(async () => {
      await browser.close();
      await server.close();
    });

    /** Opens the page after `prepare` has changed what the browser has. */
    const open = async (prepare) => {
      tab = await browser.newPage();
      errors = [];
      tab.on("pageerror", (error) => errors.push(String(error)));
      if (prepare) await tab.addInitScript(prepare);
      await tab.goto(server.url, { waitUntil: "networkidle" });
    };

    /** A minimum-jerk movement at the pace of a hand, the share `to` of it; returns what was best and which icons were lit after each sample. */
    const move = async (from, [x, y], to = 1) => {
      const shown = [];
      for (let k = 0; k <= 40 * to; k++) {
        const u = k / 40;
        const way = 10 * u ** 3 - 15 * u ** 4 + 6 * u ** 5;
        await tab.mouse.move(from[0] + (x - from[0]) * way, from[1] + (y - from[1]) * way);
        await tab.waitForTimeout(12);
        shown.push({ best: await tab.evaluate(() => window.best), lit: await next() });
      }
      return shown;
    };
    const next = () => tab.evaluate(() => [...document.querySelectorAll(".next")].map(({ id }) => id));
    const times = (shown, id) => shown.filter(({ lit }) => lit.includes(id)).length;
    const everLit = (shown) => [...new Set(shown.flatMap(({ lit }) => lit))];
    /** As long as a hand rests before another movement: a time that is tested, as that between the samples of a movement. */
    const rest = () => tab.waitForTimeout(400);
    const finish = async () => {
      assert.deepEqual(errors, []);
      await tab.close();
    };

    it("marks the icon that the mouse is going to, before it is there, and no other", async () => {
      await open();
      const shown = await move(start, last, 0.7);
      assert.deepEqual([everLit(shown), await next()], [["icon3"], ["icon3"]]);
      await finish();
    });

    it("follows icons that move, hide and appear: measured when a movement begins", async () => {
      await open();
      await move(start, last, 0.7);
      await tab.evaluate(() => {
        const [zero, , , three] = ["icon0", "icon1", "icon2", "icon3"].map((id) => document.getElementById(id));
        [zero.style.left, three.style.left] = [three.style.left, zero.style.left];
      });
      await rest();
      await move(start, last, 0.7);
      assert.deepEqual(await next(), ["icon0"]);
      await tab.evaluate(() => document.querySelectorAll("[data-icon]").forEach((icon) => (icon.style.display = "none")));
      await tab.mouse.down();
      await tab.mouse.up();
      await move(start, last, 0.7);
      assert.deepEqual(await next(), []);
      await tab.evaluate(() => (document.getElementById("hidden").style.cssText = "left:1000px"));
      await rest();
      await move(start, last, 0.7);
      assert.deepEqual(await next(), ["hidden"]);
      await finish();
    });

    it("works without getCoalescedEvents", async () => {
      await open(() => delete PointerEvent.prototype.getCoalescedEvents);
      assert.equal(await tab.evaluate(() => "getCoalescedEvents" in PointerEvent.prototype), false);
      await move(start, last, 0.7);
      assert.deepEqual(await next(), ["icon3"]);
      await finish();
    });

    it("takes a clock that steps back as a new movement", async () => {
      await open(() => {
        const { get } = Object.getOwnPropertyDescriptor(Event.prototype, "timeStamp");
        window.step = 0;
        Object.defineProperty(Event.prototype, "timeStamp", {
          get() {
            return get.call(this) + window.step;
          },
        });
      });
      await move(start, [148, 348], 0.6);
      await tab.evaluate(() => (window.step = -1000));
      await move(start, last, 0.7);
      assert.deepEqual(await next(), ["icon3"]);
      await finish();
    });

    it("begins a new movement after a rest: what was before it does not count", async () => {
      await open();
      await move(last, start);
      await rest();
      const rested = await move(start, last, 0.7);
      await tab.close();
      await open();
      const fresh = await move(start, last, 0.7);
      const [one, other] = [rested, fresh].map((shown) => times(shown, "icon3"));
      assert.deepEqual([everLit(rested), Math.abs(one - other) <= 3], [["icon3"], true], `${one}, ${other}`);
      await finish();
    });

    it("lights at .8 and goes out below .5", async () => {
      await open();
      // past the last icon on the way up, and back: sure at first, and then less and less
      const shown = [
        ...(await move(start, last, 0.7)),
        ...(await move([823, 424], [700, 600])),
        ...(await move([700, 600], [500, 420])),
      ];
      let lit = [];
      const counted = { kept: 0, waited: 0 };
      for (const { best, lit: now } of shown) {
        const enough = lit.includes(best.id) ? 0.5 : 0.8;
        if (best.probability >= 0.5 && best.probability < 0.8) counted[enough === 0.5 ? "kept" : "waited"] += 1;
        lit = best.probability >= enough ? [best.id] : [];
        assert.deepEqual(now, lit, JSON.stringify(best));
      }
      assert.ok(counted.kept > 0 && counted.waited > 0, JSON.stringify(counted));
      await finish();
    });

    it("never marks the icon that the mouse comes from", async () => {
      await open();
      await tab.mouse.move(148, 348);
      await rest();
      // whatever the predictor may find: it is made sure of each icon in turn
      const lit = {};
      for (const id of ["icon0", "icon1"]) {
        await tab.evaluate((id) => (window.instead = { id, index: 0, probability: 0.95 }), id);
        lit[id] = everLit(await move([148, 348], [160, 340], 0.2));
      }
      assert.deepEqual(lit, { icon0: [], icon1: ["icon1"] });
      await finish();
    });
  });
}
