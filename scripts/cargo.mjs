// Cargo, with progress while it compiles, and without output where there is nothing to compile.
import { capture, Failure } from "./run.mjs";
import { stage } from "./stage.mjs";

/** Its bar, which has the numbers, wherever its output goes. */
const bar = {
  CARGO_TERM_PROGRESS_WHEN: "always",
  CARGO_TERM_PROGRESS_WIDTH: "80",
  CARGO_TERM_COLOR: "never",
  // of what is compiled, others write about the future at every start
  CARGO_FUTURE_INCOMPAT_REPORT_FREQUENCY: "never",
};

/** What it prints of its own work; everything else is a warning or an error. */
const WORK = /^\s*(Compiling|Building|Downloading|Downloaded|Updating|Locking|Adding|Blocking|Finished|Executable)\b/;

/** What takes its time. */
const LONG = /^\s*(Compiling|Downloading|Updating|Blocking)\b/;

/** Runs `cargo build` or another of its commands that compile, reported as `what`; warnings and errors are shown at the end. */
export async function compile(what, args, { env = {}, ...options } = {}) {
  let running = null;
  let cut = "";
  const others = [];
  const read = (text) => {
    // the bar is written over itself: it ends with a carriage return
    const lines = (cut + text).replace(/\x1b\[\w*/g, "").split(/[\r\n]/);
    cut = lines.pop();
    for (const line of lines) {
      if (LONG.test(line)) running ??= stage(what);
      const [, done, all] = line.match(/^\s*Building .* (\d+)\/(\d+)/) ?? [];
      if (done !== undefined) running?.more(`${done} of ${all} compiled`);
      else if (/^\s*(Downloading|Blocking)/.test(line)) running?.more(line.trim().toLowerCase());
      if (!WORK.test(line)) others.push(line);
    }
  };
  const { code } = await capture("cargo", args, { env: { ...bar, ...env }, watch: read, ...options }).finally(() =>
    running?.end(),
  );
  read("\n");
  const shown = others.join("\n").trim();
  if (shown !== "") console.error(shown);
  if (code !== 0) throw new Failure(`cargo ${args.join(" ")} failed (exit code ${code})`);
}
