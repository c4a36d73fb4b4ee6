// `npm run release:check`: what each registry would be given, without a warning and under one version.
import { readFileSync } from "node:fs";
import { join } from "node:path";
import { capture, Failure, main, root } from "./run.mjs";
import { during } from "./stage.mjs";

/** Warnings that every dry run has: no login, no upload, the tests stay in the repository. */
const USUAL = [
  /^npm warn publish This command requires you to be logged in to \S+ \(dry-run\)$/,
  /^warning: ignoring test `\w+` as `tests\/\S+` is not included in the published package$/,
  /^warning: aborting upload due to dry run$/,
];

/** The warnings in what a registry's client printed. */
export function warnings(output) {
  const lines = output.split("\n").filter((line) => /^(npm warn|warning:)/i.test(line));
  return lines.filter((line) => !USUAL.some((usual) => usual.test(line)));
}

/** The version in each file that has it. */
export function versions() {
  const read = (name) => readFileSync(join(root, name), "utf8");
  const json = (name) => JSON.parse(read(name)).version;
  return {
    "package.json": json("package.json"),
    "package-lock.json": json("package-lock.json"),
    "Cargo.toml": read("Cargo.toml").match(/^version = "(.*)"$/m)?.[1],
    "CHANGELOG.md": read("CHANGELOG.md").match(/^## (\d\S*)/m)?.[1],
  };
}

async function rehearse(program, args) {
  const command = [program, ...args].join(" ");
  const { code, output } = await during(command, () => capture(program, args));
  if (code !== 0 || warnings(output).length > 0) throw new Failure(`${command} (exit code ${code})\n${output}`);
}

await main(import.meta.url, async () => {
  const found = versions();
  if (new Set(Object.values(found)).size !== 1) throw new Failure(`versions differ: ${JSON.stringify(found)}`);
  await rehearse("cargo", ["publish", "--dry-run", "--package", "whither"]);
  await rehearse("npm", ["publish", "--dry-run"]);
  console.log(`${found["package.json"]} can be published to both registries`);
});
