// The declarations for strict users, whatever else they have.
import { test } from "node:test";
import assert from "node:assert/strict";
import { mkdirSync, symlinkSync } from "node:fs";
import { join } from "node:path";
import { capture, root } from "../../scripts/run.mjs";
import { project, strict, write } from "./support.mjs";

const program = `
import { init, initSync, pointerScenario, Predictor, WhitherError, type Scenario } from "whither";
import { handScenario, rayMap, rayScenario, type AngleUnit, type HandTarget, type RayTarget } from "whither";
import { init as initSlim } from "whither/slim";
import * as pointing from "whither/pointing";
import { fit, type Track } from "whither/study";

const scenario: Scenario = {
  motion: { type: "constantVelocity", dimensions: 2, noise: 3000 },
  observation: { noise: 1.5 },
  arrival: { type: "horizon", from: 0.05, to: 0.5 },
  destinations: [{ id: "radio", center: [100, 80], size: [90, 90] }, { id: "map", mean: [600, 300], covariance: [[9, 0], [0, 9]] }],
};

export const known: Scenario = { ...scenario, arrival: { type: "discrete", times: [1, 2] } };

export async function use(bytes: ArrayBuffer): Promise<string> {
  await init();
  await initSlim({ wasm: bytes });
  initSync({ module: bytes });
  const predictor = new Predictor(scenario);
  try {
    predictor.observe(0, [300, 500]);
    predictor.observe(0.016, new Float64Array([306, 496]));
    const probabilities: Float64Array = predictor.probabilities(new Float64Array(2));
    const none: number = predictor.none;
    const best: { id: string; index: number; probability: number } | null = predictor.best;
    predictor.setDestinations(scenario.destinations);
    predictor.reset();
    return \`\${best?.id} \${probabilities[0]} \${none}\`;
  } catch (error) {
    if (error instanceof WhitherError) return \`\${error.code} \${error.path}\`;
    throw error;
  } finally {
    predictor.free();
  }
}

new Predictor(pointerScenario([{ id: "radio", x: 1, y: 2, width: 3, height: 4 }]));

export function turn(targets: readonly RayTarget[], unit: AngleUnit, matrix: Float32Array): Scenario {
  const place: (direction: Float32Array | readonly number[]) => [number, number] = rayMap([0, 0, -1], { unit });
  const [azimuth, elevation] = place(matrix.subarray(8, 11));
  return rayScenario([...targets, { id: "here", azimuth, elevation, width: 1, height: 1 }], { unit, none: 0.1, noise: 0.01 });
}
const icons: HandTarget[] = [{ id: "radio", x: 1, y: 2, width: 3, height: 4 }, { id: "map", x: 1, y: 2, z: 3, width: 4, height: 5, depth: 6 }];
new Predictor(handScenario(icons, { unit: "metres" }));
// @ts-expect-error: rays have angles
rayScenario(icons);
// @ts-expect-error: there is no such unit
handScenario(icons, { unit: "inches" });

export async function point(options: pointing.InitOptions): Promise<number> {
  await pointing.init(options);
  const targets: pointing.PointerTarget[] = [{ id: "radio", x: 1, y: 2, width: 3, height: 4, prior: 2 }];
  const constants: pointing.PointerConstants = { pointing: { power: { to: 2 } }, motion: { noise: 900 } };
  const pointer = new pointing.PointerPredictor(targets, { none: 0.1, constants });
  pointer.setTargets(targets);
  const best: pointing.Best | null = pointer.best;
  return pointer.none + (pointer.forecast(1)?.mean[0] ?? 0) + (best?.probability ?? 0);
}
export const learnt = async (tracks: readonly Track[], targets: pointing.PointerTarget[]): Promise<pointing.PointerPredictor> =>
  new pointing.PointerPredictor(targets, { constants: (await fit(tracks, pointerScenario(targets))).scenario });
// @ts-expect-error: there is no such constant
void new pointing.PointerPredictor([], { constants: { pointing: { speed: 1 } } });
// @ts-expect-error: there are no sequences
void pointing.ConditionallyMarkovSequence;

export async function learn(tracks: readonly Track[]): Promise<Scenario> {
  const fitted = await fit(tracks, scenario, { constants: ["motion.noise"], progress: ({ share }) => share < 0.5 });
  const gain: number = fitted.leftOut.before - fitted.leftOut.after;
  return gain > 0 ? fitted.scenario : scenario;
}
// @ts-expect-error: a target is a place
void learn([{ targets: [[0, 0, 1, 1]], target: "radio", samples: [[0, 1, 2]] }]);

// @ts-expect-error: there is no such type of motion
new Predictor({ ...scenario, motion: { type: "constantSpeed", dimensions: 2, noise: 1 } });
// @ts-expect-error: a time is a number
new Predictor(scenario).observe("0", [1, 2]);
`;

/** A page's program: for users who have the DOM. */
const onPage = `
import { links as ahead, type Exclusion, type LinksStats } from "whither/links";
import { watch, WhitherError, type Inspection, type Intent, type Snapshot, type VirtualTarget, type Watcher, type WatchOptions } from "whither/dom";
import { overlay, type Overlay, type OverlayOptions } from "whither/overlay";
import { handleClose, heldOpen, menu, type Closing, type HeldOpen, type Menu, type MenuOptions } from "whither/menu";
import { PointerPredictor } from "whither/pointing";
import type { Track } from "whither/study";

const options: WatchOptions<HTMLAnchorElement> = {
  threshold: 0.85,
  target: (link) => ({ id: link.id, prior: 2, hitSlop: { top: 4 }, data: { href: link.href } }),
  reasons: { pointer: { after: 50 }, hover: false, keyboard: { tabs: 2 } },
  limit: { running: 3 },
  load: "idle",
  onIntent: async ({ target, signal, reason, probability, remaining }) => {
    const response = await fetch(target.href, { signal });
    return \`\${reason} \${probability} \${remaining?.mean} \${response.status}\`;
  },
  onRelease: ({ target, pressed }) => target.classList.toggle("is-pressed", pressed),
  onPrediction: ({ best }) => console.log(best?.target.href),
  onError: (error) => { if (error instanceof WhitherError) console.warn(error.code, error.path); },
};
const links: Watcher<HTMLAnchorElement> = watch<HTMLAnchorElement>("nav a", options);
const best: HTMLAnchorElement | undefined = links.best?.target;
links.update({ threshold: undefined, none: 0.1 });
links.set(links.targets[0]!, { enabled: false });
const snapshot: Snapshot<HTMLAnchorElement> = links.getSnapshot();
const unsubscribe: () => void = links.subscribe(() => console.log(snapshot.intended, best));
const x: number | undefined = links.forecast(0.1)?.mean[0];
export const lines: string[] = links.ledger.lines();
export const tracks: Track[] = lines.map((line) => JSON.parse(line));
const how: OverlayOptions = { theme: "dark", collapsed: undefined, shortcut: null, signal: new AbortController().signal };
const drawn: Overlay = overlay(links, how);
if (drawn.state !== "closed") drawn.close();
overlay([links, watch("button")]).hide();
overlay().close();
// @ts-expect-error: a selector is no watcher
overlay("nav a");
// @ts-expect-error: there is no such theme
overlay(links, { theme: "blue" });
const answers = ({ options, optionsOf, reasonOf, watcher }: Inspection) => [options.none, optionsOf, reasonOf, watcher.targets];
dispatchEvent(new CustomEvent("whither:inspect", { detail: answers }));
links.stop();
unsubscribe();

// an element's own type is Element where nothing else is stated
watch("button", { onIntent: ({ target }) => target.setAttribute("data-intended", "") });
watch(document.querySelectorAll("li"), { root: document.body });
const shape: VirtualTarget = { id: "shape", bounds: () => new DOMRect(1, 2, x, 4) };
watch<Element | VirtualTarget>([shape, document.body], {
  onIntent: (intent: Intent<Element | VirtualTarget>) => ("bounds" in intent.target ? intent.target.bounds() : intent.id),
});
watch<VirtualTarget>(shape, {
  predictor: (targets, { none, constants }) => new PointerPredictor(targets, { none, constants }),
  signal: AbortSignal.abort(),
});
const loading = ahead({
  ignore: [/admin/, ".slow", (url, link) => url.searchParams.has("draft") && link.id === "draft"],
  limit: { running: 1 },
  prerender: { threshold: 0.97 },
  mechanism: async ({ url, signal }) => fetch(url, { signal }),
  target: (link) => ({ prior: link.matches("nav *") ? 2 : 1 }),
  onPrefetch: ({ url, mechanism, probability }) => console.log(url, mechanism, probability),
});
export const stats: LinksStats = loading.stats();
export const excluded: Exclusion | null = loading.excluded(loading.watcher.targets[0]!);
// @ts-expect-error: a mechanism is one of three, or a function
ahead({ mechanism: "own" });

const menuOptions: MenuOptions = {
  submenu: (item) => item.querySelector("ul"),
  onOpen: ({ item, panel }) => panel.append(item.id),
  onClose: ({ why }) => console.log(why === "closed"),
  bound: undefined,
};
const menus: Menu = menu(document.body, menuOptions);
export const opened: Element[] = menus.open.map(({ panel }) => panel);
const held: HeldOpen = heldOpen(document.body, () => document.querySelectorAll(".card"), {
  onClose: ({ why, probability, over }: Closing) => console.log(why, probability, over?.id),
});
held.update({ delay: 100 });
export const blocks: boolean = handleClose({ release: 0.3 }).__options.blockPointerEvents;
// @ts-expect-error: something has to close it
heldOpen(document.body, document.body, {});
// @ts-expect-error: there is no such option
watch("a", { treshold: 0.8 });
// @ts-expect-error: there is no such reason
watch("a", { reasons: { gaze: true } });
// @ts-expect-error: a virtual target has its bounds
watch({ id: "shape" });
`;

/** The WebAssembly, as an import of it gives it. */
const imported = (entry) => `
import compiledModule from "${entry}";
import { init, initSync } from "whither/slim";

export const loaded = init({ wasm: compiledModule });
initSync({ module: compiledModule });
`;

const dom = ["ES2022", "DOM"];
const users = {
  "ES2020 and nothing else": { target: "ES2020", lib: ["ES2020"], module: "nodenext", moduleResolution: "nodenext" },
  "a bundler and the DOM": { target: "ES2022", lib: dom, module: "esnext", moduleResolution: "bundler" },
  "the newest libraries": { target: "ESNext", lib: ["ESNext", "DOM"], module: "preserve" },
  "a resolver that does not read exports": { target: "ES2022", lib: dom, module: "esnext", moduleResolution: "node10" },
};
const compilers = { "this TypeScript": "typescript", "the oldest one": "typescript-floor" };

test("the declarations compile", async (t) => {
  const { folder } = await project(t);
  const compiles = async (files, options, compiler = "typescript") => {
    for (const [name, text] of Object.entries(files)) write(folder, name, text);
    write(folder, "tsconfig.json", JSON.stringify({ compilerOptions: { ...strict, ...options }, files: Object.keys(files) }));
    const { code, output } = await capture("node", [join(root, "node_modules", compiler, "bin/tsc")], { cwd: folder });
    assert.equal(code, 0, output);
  };

  for (const [name, options] of Object.entries(users)) {
    for (const [by, compiler] of Object.entries(compilers)) {
      // "preserve" is younger than it
      if (compiler === "typescript-floor" && options.module === "preserve") continue;
      await t.test(`for ${name}, by ${by}`, () => compiles({ "use.ts": program }, options, compiler));
      if (options.lib.includes("DOM")) {
        // what `querySelectorAll` returns is iterable
        const lib = [...options.lib, "DOM.Iterable"];
        await t.test(`for ${name}, by ${by}, on a page`, () => compiles({ "page.ts": onPage }, { ...options, lib }, compiler));
      }
      await t.test(`for ${name}, by ${by}, with the WebAssembly by import`, async () => {
        const where = options.moduleResolution === "node10" ? "whither/dist" : "whither";
        const modules = ["whither.wasm", "pointing.wasm"].map((file) => [`${file}.ts`, imported(`${where}/${file}`)]);
        await compiles(Object.fromEntries(modules), options, compiler);
      });
    }
  }

  await t.test("where the library has WebAssembly, an imported module is one", async () => {
    const text =
      'import module from "whither/whither.wasm"; export const names: string[] = WebAssembly.Module.exports(module).map(({ name }) => name);';
    await compiles({ "module.ts": text }, users["a bundler and the DOM"]);
  });

  await t.test("for a CommonJS file", async () => {
    const text = 'import whither = require("whither"); import { fit } from "whither/study"; export = [whither.init(), fit];';
    await compiles({ "common.cts": text }, { target: "ES2022", lib: ["ES2022"], module: "nodenext" });
  });

  await t.test("and floating-ui takes what handleClose returns", async () => {
    mkdirSync(join(folder, "node_modules/@floating-ui"), { recursive: true });
    symlinkSync(join(root, "node_modules/@floating-ui/react"), join(folder, "node_modules/@floating-ui/react"));
    const text = `import type { UseHoverProps } from "@floating-ui/react"; import { handleClose } from "whither/menu";
      export const props: UseHoverProps = { handleClose: handleClose({ blockPointerEvents: true }) };
      // @ts-expect-error: it takes one
      export const wrong: UseHoverProps = { handleClose: handleClose };`;
    await compiles(
      { "floating.ts": text },
      { ...users["a bundler and the DOM"], lib: [...dom, "DOM.Iterable"], skipLibCheck: true },
    );
  });

  await t.test("and `using` frees", async () => {
    const text = `import { ConditionallyMarkovSequence, Predictor, type Scenario, type SequenceParameters } from "whither";
      export function use(scenario: Scenario, parameters: SequenceParameters) {
        using predictor = new Predictor(scenario);
        using sequence = new ConditionallyMarkovSequence(parameters);
        return [predictor.none, sequence.destination()];
      }`;
    await compiles({ "using.ts": text }, { target: "ES2022", lib: ["ES2022", "ESNext.Disposable"], module: "nodenext" });
  });

  await t.test("and take what a browser has as the WebAssembly", async () => {
    const text = `import { init } from "whither/slim";
      export const all = (module: WebAssembly.Module, view: Uint8Array) =>
        [new URL("https://example.org/"), fetch("/whither.wasm"), new Response(), "/whither.wasm", view, view.buffer, module].map((wasm) => init({ wasm }));`;
    await compiles({ "browser.ts": text }, users["a bundler and the DOM"]);
  });
});
