// `npm run release:check`: what each registry would be given, without a warning and under one version.
// `npm run release:check -- --repository https://HOST/OWNER/NAME`: first writes that address into every manifest that has one.
import { readFileSync, writeFileSync } from "node:fs";
import { parseArgs } from "node:util";
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

/** The manifest of npm with the addresses that follow from a repository's. */
export function npmWith(manifest, repository) {
  const { license, ...rest } = JSON.parse(manifest);
  const entries = Object.entries({ ...rest, license }).filter(
    ([key]) => !["repository", "homepage", "bugs", "license"].includes(key),
  );
  const at = entries.findIndex(([key]) => key === "description") + 1;
  entries.splice(
    at,
    0,
    ["license", license],
    ["homepage", repository],
    ["repository", { type: "git", url: `git+${repository}.git` }],
    ["bugs", { url: `${repository}/issues` }],
  );
  return `${JSON.stringify(Object.fromEntries(entries), null, 2)}\n`;
}

/** The manifest of a crate with them. */
export function crateWith(manifest, repository) {
  const lines = manifest.split("\n").filter((line) => !/^(repository|homepage) = /.test(line));
  const at = lines.findIndex((line) => line.startsWith("license = ")) + 1;
  lines.splice(at, 0, `homepage = "${repository}"`, `repository = "${repository}"`);
  return lines.join("\n");
}

/** Writes a repository's address wherever it belongs. */
function setRepository(repository) {
  if (!/^https:\/\/[\w.-]+(\/[\w.-]+){2,}$/.test(repository) || repository.endsWith(".git"))
    throw new Failure(`--repository is ${JSON.stringify(repository)}: it must be as https://github.com/OWNER/NAME`);
  const edit = (name, change) => writeFileSync(join(root, name), change(readFileSync(join(root, name), "utf8"), repository));
  edit("package.json", npmWith);
  for (const name of ["Cargo.toml", "kernel/Cargo.toml"]) edit(name, crateWith);
}

async function rehearse(program, args) {
  const command = [program, ...args].join(" ");
  const { code, output } = await during(command, () => capture(program, args));
  if (code !== 0 || warnings(output).length > 0) throw new Failure(`${command} (exit code ${code})\n${output}`);
}

await main(import.meta.url, async () => {
  const { values } = parseArgs({ options: { repository: { type: "string" } } });
  if (values.repository !== undefined) setRepository(values.repository);
  if (JSON.parse(readFileSync(join(root, "package.json"), "utf8")).repository === undefined)
    throw new Failure(
      "no manifest names the repository: npm run release:check -- --repository https://HOST/OWNER/NAME writes it into all of them",
    );
  const found = versions();
  if (new Set(Object.values(found)).size !== 1) throw new Failure(`versions differ: ${JSON.stringify(found)}`);
  await rehearse("cargo", ["publish", "--dry-run", "--package", "whither"]);
  await rehearse("npm", ["publish", "--dry-run"]);
  console.log(`${found["package.json"]} can be published to both registries`);
});
