// Running other programs.
import { spawn } from "node:child_process";
import { fileURLToPath } from "node:url";

/** The repository. */
export const root = fileURLToPath(new URL("..", import.meta.url));

/**
 * The user's environment, but for the compiler flags in it: they would silently replace those of .cargo/config.toml, SIMD among
 * them, and reach what builds the package.
 */
export const environment = { ...process.env };
delete environment.RUSTFLAGS;
delete environment.CARGO_ENCODED_RUSTFLAGS;

/** A failure that is printed in one sentence, without a stack. */
export class Failure extends Error {}

/**
 * Runs a program in the repository and gives its exit code and what it printed.
 * With `show`, the output also goes to the terminal as it comes; `watch` is given it as it comes.
 */
export function capture(program, args, { env = {}, cwd = root, show = false, watch } = {}) {
  return new Promise((resolve, reject) => {
    const child = spawn(program, args, {
      cwd,
      env: { ...environment, ...env },
      stdio: ["ignore", "pipe", "pipe"],
      // On Windows npm is a script, which only a shell can start.
      shell: process.platform === "win32" && program === "npm",
    });
    let output = "";
    for (const stream of ["stdout", "stderr"]) {
      child[stream].setEncoding("utf8").on("data", (text) => {
        output += text;
        if (show) process[stream].write(text);
        watch?.(text);
      });
    }
    child.on("error", reject);
    child.on("close", (code) => resolve({ code: code ?? 1, output }));
  });
}

/** Runs a program, its output shown; a failure of it is a failure of ours. */
export async function run(program, args, options) {
  const { code } = await capture(program, args, { ...options, show: true });
  if (code !== 0) throw new Failure(`${program} ${args.join(" ")} failed (exit code ${code})`);
}

/** What a program prints, or null where it is not there or fails. */
export async function answer(program, args) {
  try {
    const { code, output } = await capture(program, args);
    return code === 0 ? output.trim() : null;
  } catch {
    return null;
  }
}

/** Runs the work of a command line script if `url` is that script; prints a `Failure` in one line. */
export async function main(url, work) {
  if (process.argv[1] === undefined || fileURLToPath(url) !== process.argv[1]) return;
  try {
    await work();
  } catch (error) {
    console.error(error instanceof Failure ? `\n${error.message}` : error);
    process.exitCode = 1;
  }
}
