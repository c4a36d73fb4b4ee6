// `npm run evaluate` and `npm run reproduce`: a program of tools/, compiled first where it has changed.
import { spawn } from "node:child_process";
import { readFileSync } from "node:fs";
import { join } from "node:path";
import { compile } from "./cargo.mjs";
import { environment, main, root } from "./run.mjs";

await main(import.meta.url, async () => {
  const [name, ...args] = process.argv.slice(2);
  // a test of the program holds that it would answer the same
  if (args.includes("--help") || args.includes("-h")) {
    process.stdout.write(readFileSync(join(root, `tools/${name}/help.txt`), "utf8"));
    return;
  }
  const which = ["--profile", "tools", "--package", name];
  await compile(`compiling ${name}`, ["build", ...which]);
  const program = spawn("cargo", ["run", "--quiet", ...which, "--", ...args], { cwd: root, env: environment, stdio: "inherit" });
  process.exitCode = await new Promise((resolve, reject) =>
    program.on("error", reject).on("close", (code) => resolve(code ?? 1)),
  );
});
