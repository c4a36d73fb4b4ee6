/**
 * Which links are loaded ahead, and which never.
 *
 * @module
 */
import { CONNECTIONS, type Settings } from "./options.js";
import type { Exclusion, Ignore } from "./types.js";
import { wordsOf } from "./unsafe.js";

/** What a page may state of a link, or of all in an element: `no`, or `yes`, which only the options overrule. */
const CHOICE = "data-whither-prefetch";

/** Links that are buttons, ask first, or send with another method: as ARIA, Rails, Turbo and htmx mark them. */
const ACTION =
  "[role=button],[onclick],[data-method],[data-turbo-method],[data-turbo-stream],[data-remote],[data-confirm],[data-turbo-confirm],[hx-post],[hx-put],[hx-patch],[hx-delete],[hx-confirm]";

/** Files that are saved, or large. */
const FILE =
  /\.(7z|apk|avi|bin|bz2|csv|deb|dmg|docx?|epub|exe|flac|gz|ics|img|iso|jar|m4a|mkv|mov|mp[34]|mpe?g|msi|od[pst]|og[agv]|pdf|pkg|pptx?|rar|rpm|tar|tgz|torrent|wasm|wav|webm|wm[av]|xlsx?|xz|zip)$/i;

/** Where a link leads; null for nowhere. */
export function addressOf(link: Element): URL | null {
  const address = link.getAttribute("href");
  try {
    return address === null ? null : new URL(address, link.baseURI);
  } catch {
    return null;
  }
}

/** An address without its fragment: that of a document. */
export function documentOf({ href }: URL): string {
  return href.replace(/#.*/, "");
}

/** Why a link is not loaded; null if it is. */
export function exclusionOf(link: Element, url: URL | null, settings: Settings): Exclusion | null {
  return exclusionByLink(link, url, settings) ?? exclusionByConnection(link.ownerDocument.defaultView, settings);
}

function exclusionByLink(link: Element, url: URL | null, { origins, ignore, unsafe }: Settings): Exclusion | null {
  const page = link.ownerDocument;
  if (!url || !/^https?:$/.test(url.protocol)) return "address";
  if (url.origin !== page.defaultView?.origin && !origins.includes("*") && !origins.includes(url.origin)) return "origin";
  if (documentOf(url) === documentOf(new URL(page.URL))) return "here";
  if (link.hasAttribute("download")) return "download";
  const choice = link.closest(`[${CHOICE}]`)?.getAttribute(CHOICE);
  if (choice === "no") return "attribute";
  if (ignore.some((one) => isIgnored(link, url, one))) return "ignore";
  if (choice === "yes") return null;
  const target = link.getAttribute("target") ?? page.querySelector("base[target]")?.getAttribute("target");
  if (target && !/^_self$/i.test(target)) return "target";
  if (/(^|\s)(nofollow|external)(\s|$)/i.test(link.getAttribute("rel") ?? "")) return "rel";
  if (link.matches(ACTION)) return "action";
  if (FILE.test(url.pathname)) return "file";
  // not `test`, which goes on from where it was for a regular expression with the flag g
  if (unsafe && wordsOf(url).search(unsafe) >= 0) return "unsafe";
  return null;
}

function isIgnored(link: Element, url: URL, ignore: Ignore): boolean {
  if (typeof ignore === "function") return ignore(url, link);
  return typeof ignore === "string" ? link.matches(ignore) : url.href.search(ignore) >= 0;
}

/** What browsers state of the connection, where they do. */
interface Connection {
  readonly saveData?: boolean;
  readonly effectiveType?: unknown;
}

function exclusionByConnection(view: Window | null, { slowest }: Settings): Exclusion | null {
  const navigator = view?.navigator as { readonly onLine?: boolean; readonly connection?: Connection } | undefined;
  const { saveData, effectiveType } = navigator?.connection ?? {};
  if (saveData || view?.matchMedia?.("(prefers-reduced-data: reduce)").matches) return "saveData";
  const speed = CONNECTIONS.indexOf(effectiveType);
  return navigator?.onLine === false || (speed >= 0 && speed < slowest) ? "connection" : null;
}
