// The browser of the tests: the Chromium or Chrome that is installed.
import { existsSync } from "node:fs";
import { answer, Failure, run } from "./run.mjs";
import { during } from "./stage.mjs";

const programs = ["chromium", "chromium-browser", "google-chrome-stable", "google-chrome", "chrome"];
const places = [
  "/usr/bin/chromium",
  "/snap/bin/chromium",
  "/Applications/Google Chrome.app/Contents/MacOS/Google Chrome",
  "/Applications/Chromium.app/Contents/MacOS/Chromium",
  "C:\\Program Files\\Google\\Chrome\\Application\\chrome.exe",
  "C:\\Program Files (x86)\\Google\\Chrome\\Application\\chrome.exe",
];

/** The path of the browser; null where there is none. */
export async function pathOfChromium() {
  if (process.env.CHROME) return process.env.CHROME;
  for (const program of programs) {
    const path = process.platform === "win32" ? null : await answer("which", [program]);
    if (path) return path;
  }
  return places.find(existsSync) ?? null;
}

/** Installs Chromium where that can be done without asking: as root on Debian and its kin. */
export async function ensureChromium() {
  if ((await pathOfChromium()) !== null) return;
  if (process.getuid?.() === 0 && (await answer("apt-get", ["--version"])) !== null) {
    const env = { DEBIAN_FRONTEND: "noninteractive" };
    await during("installing Chromium", async () => {
      await run("apt-get", ["update", "--quiet", "--quiet"], { env });
      await run("apt-get", ["install", "--yes", "--quiet", "--quiet", "--no-install-recommends", "chromium"], { env });
    });
  }
  if ((await pathOfChromium()) !== null) return;
  throw new Failure(
    "the tests need a browser: install Chromium (Debian and Ubuntu: sudo apt-get install chromium) or Google Chrome, " +
      "or set CHROME to the path of one",
  );
}

/** Starts it; the result is playwright's Browser. */
export async function launch() {
  const { chromium } = await import("playwright-core");
  const executablePath = await pathOfChromium();
  if (executablePath === null) throw new Failure("there is no browser: npm test installs one or prints how");
  return chromium.launch({
    executablePath,
    // As root there is no sandbox; the rest keeps the browser from looking for the network.
    args: [
      "--no-sandbox",
      "--disable-gpu",
      "--disable-quic",
      "--no-first-run",
      "--disable-background-networking",
      "--disable-component-update",
      "--disable-sync",
    ],
  });
}
