/** How every page begins. */
import type { Status } from "./status.ts";

/** An element that the page's HTML promises. */
export function part<T extends Element = HTMLElement>(id: string): T {
  return document.getElementById(id) as unknown as T;
}

/** Starts a page. `<html>` then has `data-ready`, or `data-failed` where it could not start, which the status states. */
export function begin(status: Status, start: () => Promise<void>): void {
  const { dataset } = document.documentElement;
  start().then(
    () => {
      dataset["ready"] = "true";
      keepOffline();
    },
    (error: unknown) => {
      dataset["failed"] = "true";
      status.write(`This page could not start: ${reasonOf(error)}`, true);
    },
  );
}

/** What went wrong, in words. */
export function reasonOf(error: unknown): string {
  return error instanceof Error ? error.message : String(error);
}

/** Once there is time for it, the service worker fetches what the pages need without a network; where there can be none, nothing. */
function keepOffline(): void {
  if (!import.meta.env.PROD || !("serviceWorker" in navigator)) return;
  const address = new URL("offline.js", part<HTMLAnchorElement>("home").href);
  const register = () => void navigator.serviceWorker.register(address).catch(() => undefined);
  if ("requestIdleCallback" in window) requestIdleCallback(register, { timeout: 10_000 });
  else setTimeout(register, 2000);
}
