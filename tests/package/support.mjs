// A user's empty project with the packed package in it, and pages of it in the browser.
import { cpSync, mkdirSync, mkdtempSync, readFileSync, realpathSync, rmSync, writeFileSync } from "node:fs";
import { tmpdir } from "node:os";
import { join } from "node:path";
import assert from "node:assert/strict";
import { capture, root } from "../../scripts/run.mjs";
import { serve } from "../../scripts/serve.mjs";

/** The case that every project computes; an independent reference gave its numbers. */
const golden = JSON.parse(readFileSync(join(root, "tests/golden/cv2d-position.json"), "utf8"));
const method = "pseudoObservation";
const scenario = { method };
for (const key of ["motion", "observation", "initial", "arrival", "quadrature", "destinations"]) {
  if (key in golden) scenario[key] = golden[key];
}

/** The user's code: what the predictor returns after all observations. It takes the package's exports. */
const predict = `
const scenario = ${JSON.stringify(scenario)};
const observations = ${JSON.stringify(golden.observations)};
export async function predict({ init, Predictor }, options) {
  await init(options);
  const predictor = new Predictor(scenario);
  for (const [time, ...position] of observations) predictor.observe(time, position);
  return Array.from(predictor.probabilities());
}
`;

/** What strict users ask of the compiler, whatever else they have. */
export const strict = { strict: true, skipLibCheck: false, noEmit: true, exactOptionalPropertyTypes: true, types: [] };

/** What `predict` must give. */
export function assertPredicted(probabilities) {
  const expected = golden.expected.probabilities[method].at(-1);
  assert.equal(probabilities?.length, expected.length, `got ${JSON.stringify(probabilities)}`);
  expected.forEach((p, i) => assert.ok(Math.abs(probabilities[i] - p) < 1e-9, `${i}: ${probabilities[i]}, expected ${p}`));
}

/**
 * Packs the package and installs the tarball into an empty project. Gives its folder, the path of the tarball and the list of its
 * files; all is removed after the test.
 */
export async function project(t) {
  const folder = realpathSync(mkdtempSync(join(tmpdir(), "whither-package-")));
  t.after(() => rmSync(folder, { recursive: true, force: true }));
  write(folder, "package.json", JSON.stringify({ name: "a-users-project", private: true, type: "module" }));
  const { tarball, files } = await install(folder);
  write(folder, "predict.js", predict);
  return { folder, tarball, files };
}

/** Packs the package into a project's folder and installs it there, beside what is installed there. */
export async function install(folder) {
  // What else npm prints goes to standard error, so only the JSON is read.
  const packed = await npm(["pack", "--ignore-scripts", "--json", "--pack-destination", folder], root);
  const [{ filename, files }] = Object.values(JSON.parse(packed.slice(packed.search(/^[[{]/m))));
  const tarball = join(folder, filename);
  await npm(["install", "--no-save", "--offline", "--no-audit", "--no-fund", tarball], folder);
  return { tarball, files: files.map(({ path }) => path) };
}

async function npm(args, cwd) {
  const { code, output } = await capture("npm", [...args, "--loglevel=error"], { cwd });
  assert.equal(code, 0, output);
  return output;
}

/** Writes a file of the project. */
export function write(folder, name, text) {
  mkdirSync(join(folder, name, ".."), { recursive: true });
  writeFileSync(join(folder, name), text);
}

/** Copies a file of the installed package to another place in the project. */
export function copy(folder, from, to) {
  cpSync(join(folder, "node_modules/whither", from), join(folder, to));
}

/** Runs a program of the user's in Node; what it prints is JSON. */
export async function inNode(folder, name, text) {
  write(folder, name, text);
  const { code, output } = await capture("node", [name], { cwd: folder });
  assert.equal(code, 0, output);
  return JSON.parse(output);
}

/** A page whose script puts a promise in `window.outcome`. */
export function page(script) {
  return `<!doctype html><html lang="en"><head><meta charset="utf-8"><title>A user's page</title>
<link rel="icon" href="data:,"></head><body>${script}</body></html>`;
}

/**
 * Gives what `use(tab)` does with a tab of its own. Any error that the browser reports fails, but for those that match `expected`.
 */
export async function inTab(browser, use, expected = null) {
  const tab = await browser.newPage();
  const errors = [];
  tab.on("pageerror", (error) => errors.push(String(error)));
  tab.on("console", (message) => message.type() === "error" && errors.push(message.text()));
  try {
    const outcome = await use(tab);
    assert.deepEqual(
      errors.filter((text) => expected === null || !expected.test(text)),
      [],
    );
    return outcome;
  } finally {
    await tab.close();
  }
}

/** Opens the folder's page in the browser and gives what its `window.outcome` comes to. Errors as in {@link inTab}. */
export async function inBrowser(browser, folder, { headers, expected = null } = {}) {
  const server = await serve(folder, { headers });
  const outcome = async (tab) => {
    await tab.goto(server.url);
    await tab.waitForFunction(() => window.outcome !== undefined);
    return tab.evaluate(() => window.outcome);
  };
  try {
    return await inTab(browser, outcome, expected);
  } finally {
    await server.close();
  }
}
