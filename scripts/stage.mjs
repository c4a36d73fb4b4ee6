// Progress on standard error: on a terminal in one line with a running count, else in a line now and then.

/** Milliseconds between two lines where there is no terminal. */
const PAUSE = 10_000;

/** Prints what begins, and how long it has taken until `end()`; `more(text)` is printed as well, such as how far it is. */
export function stage(what) {
  const terminal = process.stderr.isTTY === true;
  const begin = Date.now();
  let detail = "";
  let printed = begin;
  const seconds = () => Math.round((Date.now() - begin) / 1000);
  const line = () => `> ${what}: ${detail}${seconds()} s`;
  const again = () => {
    if (terminal) process.stderr.write(`\r${line().slice(0, (process.stderr.columns || 80) - 1)}\x1b[K`);
    else if (Date.now() - printed >= PAUSE) {
      process.stderr.write(`${line()}\n`);
      printed = Date.now();
    }
  };
  process.stderr.write(terminal ? `> ${what}` : `> ${what}\n`);
  const timer = setInterval(again, 1000);
  return {
    more(text) {
      detail = `${text}, `;
      again();
    },
    end() {
      clearInterval(timer);
      if (terminal) process.stderr.write(`\r> ${what}: ${seconds()} s\x1b[K\n`);
      else if (printed !== begin) process.stderr.write(`> ${what}: done in ${seconds()} s\n`);
    },
  };
}

/** Does `work` as a stage. */
export async function during(what, work) {
  const running = stage(what);
  try {
    return await work();
  } finally {
    running.end();
  }
}
