/**
 * Joins the other files: links that are meant are loaded, unless they are excluded.
 *
 * @module
 */
import { type Snapshot, type Watcher, watch } from "#dom";
import { dispose as disposeName } from "../core/lifetime.js";
import { addressOf, exclusionOf } from "./exclusion.js";
import { readOptions, type Settings } from "./options.js";
import { Requests } from "./requests.js";
import type { Exclusion, Links, LinksOptions, LinksStats } from "./types.js";

const dispose: typeof Symbol.dispose = disposeName;

/**
 * Loads the documents of a page's links ahead, once a pointer is on its way to them, and takes requests back when it turns away.
 *
 * Links to other origins, to what is unsafe to ask for (a logout, a cart), downloads and others are excluded by the rules of
 * docs/links.md. On a server it does nothing.
 *
 * @throws {@link WhitherError} for an unknown option or a value that is not legal.
 *
 * @example
 * ```ts
 * const ahead = links({ ignore: [/\/admin\//, ".no-prefetch"], onPrefetch: ({ url }) => console.log(url) });
 * addEventListener("pagehide", () => navigator.sendBeacon("/stats", JSON.stringify(ahead.stats())));
 * ```
 */
export function links(options?: LinksOptions): Links {
  return typeof document === "undefined" || typeof window === "undefined" ? nowhere() : new PageLinks(readOptions(options));
}

class PageLinks implements Links {
  readonly watcher: Watcher<Element>;
  readonly #settings: Settings;
  readonly #requests: Requests;
  /** Removes the listeners. */
  readonly #listening = new AbortController();

  constructor(settings: Settings) {
    this.#settings = settings;
    this.#requests = new Requests(settings);
    this.watcher = watch<Element>(settings.selector, {
      ...settings.watch,
      onIntent: (intent) => this.#load(intent.target, (url) => this.#requests.begin(url, intent)),
      onRelease: ({ target, pressed }) => (pressed ? this.#requests.press(target) : this.#requests.turnAway(target)),
    });
    this.#listen();
  }

  stats(): LinksStats {
    return this.#requests.stats();
  }

  excluded(link: Element): Exclusion | null {
    return exclusionOf(link, addressOf(link), this.#settings);
  }

  stop(): void {
    this.#listening.abort();
    this.watcher.stop();
    this.#requests.clear();
  }

  [dispose](): void {
    this.stop();
  }

  #load<T>(link: Element, run: (url: URL) => T): T | undefined {
    const url = addressOf(link);
    return url && exclusionOf(link, url, this.#settings) === null ? run(url) : undefined;
  }

  #listen(): void {
    const { watch, prerender } = this.#settings;
    const { signal } = this.#listening;
    const root = watch.root ?? document;
    const view = (root.ownerDocument ?? (root as Document)).defaultView ?? window;
    view.addEventListener("click", (event) => this.#clicked(event), { capture: true, passive: true, signal });
    // a page that comes back from the back/forward cache: what was there has been used, or dropped
    view.addEventListener("pageshow", ({ persisted }) => persisted && this.#requests.clear(), { signal });
    watch.signal?.addEventListener("abort", () => this.stop(), { signal });
    if ("prerendering" in view.document && view.document.prerendering) {
      this.watcher.pause();
      view.document.addEventListener("prerenderingchange", () => this.watcher.resume(), { once: true, signal });
    }
    if (prerender !== false) {
      const unsubscribe = this.watcher.subscribe(() => this.#prerender(prerender, this.watcher.getSnapshot()));
      signal.addEventListener("abort", unsubscribe);
    }
    if (watch.signal?.aborted) this.stop();
  }

  #clicked(event: Event): void {
    const isLink = (node: EventTarget) => (node as Element).matches?.("a[href], area[href]");
    const link = event.composedPath().find(isLink) as Element | undefined;
    const url = link && addressOf(link);
    if (url) this.#requests.use(url);
  }

  #prerender(threshold: number, { targets, intended }: Snapshot<Element>): void {
    for (const { target, probability } of targets) {
      if (probability < threshold) return;
      if (intended.includes(target)) this.#load(target, (url) => this.#requests.prerender(url, target));
    }
  }
}

/** Where there is no page. */
function nowhere(): Links {
  const { watcher, stats } = { watcher: watch([]), stats: new Requests(readOptions({})).stats() };
  const nothing = () => {};
  return { watcher, stats: () => stats, excluded: () => null, stop: nothing, [dispose]: nothing };
}
