/**
 * The three mechanisms. Each gives a promise that is fulfilled when the document is there, and takes the request back when the signal
 * aborts: what that does in Chromium is in docs/links.md.
 *
 * @module
 */
import { MECHANISMS, type Settings } from "./options.js";
import type { Mechanism, Prefetch } from "./types.js";

/** Rejects a promise of a speculation rule that the page's policies refuse: no request was made. */
export const REFUSED = Symbol();

/** What browsers send where the user follows a link, so that an answer that varies by it is found in the cache. */
const ACCEPT = "text/html,application/xhtml+xml,application/xml;q=0.9,*/*;q=0.8";

type Load = (request: Prefetch, settings: Settings) => Promise<unknown>;

const loads: Readonly<Record<Mechanism, Load>> = {
  rules: (request, settings) =>
    new Promise((resolve, reject) => {
      const refuse = () => reject(REFUSED);
      try {
        addRule("prefetch", request, settings, request.signal).addEventListener("securitypolicyviolation", refuse);
      } catch {
        refuse();
      }
      const timer = setTimeout(resolve, settings.keep);
      request.signal.addEventListener("abort", () => clearTimeout(timer));
    }),

  link: ({ url, link, signal }) =>
    new Promise((resolve, reject) => {
      const element = link.ownerDocument.createElement("link");
      const remove = () => element.remove();
      Object.assign(element, { rel: "prefetch", href: url, fetchPriority: "low", referrerPolicy: referrerPolicyOf(link) });
      element.onload = () => resolve(remove());
      element.onerror = () => {
        remove();
        reject(new Error(`cannot load ${url}`));
      };
      signal.addEventListener("abort", remove);
      append(element);
    }),

  async fetch({ url, link, signal }) {
    // so that the server knows what it is; elsewhere it would have to be asked whether this header may be sent
    const own = new URL(url).origin === link.ownerDocument.defaultView?.origin;
    const response = await fetch(url, {
      signal,
      mode: own ? "cors" : "no-cors",
      headers: { accept: ACCEPT, ...(own && { purpose: "prefetch" }) },
      referrerPolicy: referrerPolicyOf(link),
      priority: "low",
    });
    if (own && !response.ok) throw new Error(`cannot load ${url}: ${response.status}`);
    // read to the end, else it is not in the browser's cache
    await response.arrayBuffer();
  },

  own: async (request, { mechanism }) => typeof mechanism === "function" && mechanism(request),
};

/** Loads a document ahead. */
export function load(request: Prefetch, settings: Settings): Promise<unknown> {
  return loads[request.mechanism](request, settings);
}

/** The first mechanism, from the one that is wanted, that there is on the page of a link; null for none. */
export function mechanismFor(link: Element, wanted: Settings["mechanism"]): Mechanism | null {
  if (typeof wanted === "function") return "own";
  return MECHANISMS.slice(wanted).find((mechanism) => isSupported(mechanism, link.ownerDocument)) ?? null;
}

function isSupported(mechanism: Mechanism, page: Document): boolean {
  const view = page.defaultView as (Window & typeof globalThis) | null;
  try {
    if (mechanism === "fetch") return typeof view?.fetch === "function";
    if (mechanism === "link") return page.createElement("link").relList.supports("prefetch");
    // rules in a frame are not acted upon
    return view === view?.top && HTMLScriptElement.supports("speculationrules");
  } catch {
    return false;
  }
}

/** Adds a speculation rule to the page of a link, until the signal aborts. */
export function addRule(
  action: "prefetch" | "prerender",
  { url, link }: Pick<Prefetch, "url" | "link">,
  { nonce, tag, noVarySearch }: Settings,
  signal: AbortSignal,
): HTMLScriptElement {
  const page = link.ownerDocument;
  const script = page.createElement("script");
  script.type = "speculationrules";
  script.nonce = nonce ?? page.querySelector<HTMLScriptElement>("script[nonce]")?.nonce ?? "";
  script.textContent = JSON.stringify({
    [action]: [
      {
        source: "list",
        urls: [url],
        referrer_policy: referrerPolicyOf(link) || undefined,
        tag,
        expects_no_vary_search: noVarySearch,
      },
    ],
  });
  signal.addEventListener("abort", () => script.remove());
  append(script);
  return script;
}

/** What the link states of the referrer; empty where it states nothing. */
function referrerPolicyOf(link: Element): ReferrerPolicy {
  const { relList, referrerPolicy } = link as Partial<HTMLAnchorElement>;
  return relList?.contains("noreferrer") ? "no-referrer" : ((referrerPolicy ?? "") as ReferrerPolicy);
}

function append(element: Element): void {
  const { head, documentElement } = element.ownerDocument;
  (head ?? documentElement).append(element);
}
