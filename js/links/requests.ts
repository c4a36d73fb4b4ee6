/**
 * Each document once, however many links lead to it; and what came of the requests.
 *
 * @module
 */
import type { Intent } from "#dom";
import { documentOf } from "./exclusion.js";
import { addRule, load, mechanismFor, REFUSED } from "./loading.js";
import type { Settings } from "./options.js";
import type { LinksStats } from "./types.js";

const MINUTE = 60_000;

/** A document that was asked for. */
interface Request {
  readonly url: string;
  readonly begun: number;
  readonly controller: AbortController;
  /** The links to it that are meant. */
  readonly links: Set<Element>;
  done: boolean;
  used: boolean;
  /** Aborts the prerendering; null: there is none. */
  prerender: AbortController | null;
}

export class Requests {
  readonly #settings: Settings;
  /** By the address of the document. */
  readonly #requests = new Map<string, Request>();
  /** When requests of the last minute began. */
  readonly #begun: number[] = [];
  /** From request to click. */
  readonly #leads: number[] = [];
  readonly #counts = { requested: 0, cancelled: 0, failed: 0, prerendered: 0 };
  /** Mechanisms before this one are refused by the page's policies. */
  #first: Settings["mechanism"];

  constructor(settings: Settings) {
    this.#settings = settings;
    this.#first = settings.mechanism;
  }

  /**
   * Asks for the document of a link that is meant, unless it has been, or as much is asked for as may be. The promise is rejected where
   * that fails and the page wants to know, and where its callback throws.
   */
  begin(url: URL, intent: Intent<Element>): Promise<unknown> | undefined {
    const { limit, lifetime, onPrefetch, onError } = this.#settings;
    const { target: link, reason, probability } = intent;
    const now = performance.now();
    const key = documentOf(url);
    const known = this.#requests.get(key);
    if (known?.done && now - known.begun >= lifetime) {
      this.#forget(key, known);
      // a rule that is replaced at once is the same one for the browser
      return new Promise((resolve) => setTimeout(resolve)).then(() => this.#beginAgain(url, intent));
    }
    if (known) {
      known.links.add(link);
      return undefined;
    }
    const mechanism = mechanismFor(link, this.#first);
    while (this.#begun[0] !== undefined && now - this.#begun[0] >= MINUTE) this.#begun.shift();
    const running = [...this.#requests.values()].filter(({ done }) => !done).length;
    if (!mechanism || running >= limit.running || this.#begun.length >= limit.perMinute) return undefined;
    if (this.#counts.requested >= limit.total) return undefined;
    this.#begun.push(now);
    this.#counts.requested++;
    const controller = new AbortController();
    const { signal } = controller;
    // browsers take a document that a rule has fetched for this very fragment alone
    const prefetch = {
      url: mechanism === "link" || mechanism === "fetch" ? key : url.href,
      link,
      mechanism,
      reason,
      probability,
      signal,
    };
    const request: Request = {
      url: prefetch.url,
      begun: now,
      controller,
      links: new Set([link]),
      done: false,
      used: false,
      prerender: null,
    };
    this.#requests.set(key, request);
    const loading = load(prefetch, this.#settings).then(
      () => {
        request.done = true;
      },
      (error: unknown) => {
        if (signal.aborted || request.used) return undefined;
        this.#forget(key, request);
        if (error === REFUSED) return this.#beginWithNext(url, intent);
        this.#counts.failed++;
        // a request that failed is an error of the page's only where it asks for that
        return onError && Promise.reject(error);
      },
    );
    const reporting = async () => onPrefetch?.(prefetch);
    return Promise.all([loading, reporting()]);
  }

  /** Asks by the next mechanism: no request was made. */
  #beginWithNext(url: URL, intent: Intent<Element>): Promise<unknown> | undefined {
    this.#counts.requested--;
    this.#begun.pop();
    if (typeof this.#first === "number") this.#first = Math.max(1, this.#first);
    return this.#beginAgain(url, intent);
  }

  #beginAgain(url: URL, intent: Intent<Element>): Promise<unknown> | undefined {
    return intent.signal.aborted ? undefined : this.begin(url, intent);
  }

  /** Prerenders what a speculation rule has asked for. */
  prerender(url: URL, link: Element): void {
    const request = this.#requests.get(documentOf(url));
    if (!request || request.prerender || mechanismFor(link, this.#first) !== "rules") return;
    request.prerender = new AbortController();
    this.#counts.prerendered++;
    addRule("prerender", { url: request.url, link }, this.#settings, request.prerender.signal);
  }

  /** A link is not meant any more: what is asked for is taken back, unless it is there. */
  turnAway(link: Element): void {
    for (const [key, request] of this.#requests) {
      if (!request.links.delete(link) || request.links.size > 0 || request.used) continue;
      request.prerender?.abort();
      request.prerender = null;
      if (request.done) continue;
      this.#counts.cancelled++;
      this.#forget(key, request);
    }
  }

  /** A link was pressed: it is not taken back any more. */
  press(link: Element): void {
    for (const { links } of this.#requests.values()) links.delete(link);
  }

  /** A link was clicked. */
  use(url: URL): void {
    const request = this.#requests.get(documentOf(url));
    if (!request || request.used) return;
    request.used = true;
    this.#leads.push(performance.now() - request.begun);
  }

  /** Takes everything back. */
  clear(): void {
    for (const [key, request] of this.#requests) {
      if (!request.done && !request.used) this.#counts.cancelled++;
      this.#forget(key, request);
    }
  }

  stats(): LinksStats {
    const { requested, cancelled, failed, prerendered } = this.#counts;
    const leads = [...this.#leads].sort((a, b) => a - b);
    const used = leads.length;
    const running = [...this.#requests.values()].filter(({ done, used, links }) => !used && (!done || links.size > 0)).length;
    const wasted = requested - used - cancelled - failed - running;
    const middle = leads[Math.floor((used - 1) / 2)];
    return { requested, used, wasted, cancelled, failed, running, prerendered, lead: middle ?? null };
  }

  #forget(key: string, request: Request): void {
    this.#requests.delete(key);
    request.controller.abort();
    request.prerender?.abort();
  }
}
