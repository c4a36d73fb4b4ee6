/**
 * What a user of `whither/links` gives and is given.
 *
 * @module
 */
import type { Reason, Watcher, WatchOptions } from "#dom";

/**
 * How a document is loaded ahead: `rules`, a speculation rule; `link`, a `<link rel="prefetch">`; `fetch`; `own`, a function of the page's.
 */
export type Mechanism = "rules" | "link" | "fetch" | "own";

/**
 * Why a link is not loaded ahead.
 *
 * | reason | means |
 * |---|---|
 * | `address` | it has no address of `http:` or `https:` |
 * | `origin` | it leads to another origin, which `origins` does not name |
 * | `here` | it leads to the page that it is on |
 * | `download` | it has the attribute `download` |
 * | `attribute` | `data-whither-prefetch="no"` on it or around it |
 * | `ignore` | the option `ignore` names it |
 * | `target` | it opens in another window or frame |
 * | `rel` | its `rel` has `nofollow` or `external` |
 * | `action` | its attributes make it a button or another method than GET |
 * | `file` | its path has the extension of a file that is no page |
 * | `unsafe` | its address has a word of the rule for unsafe links |
 * | `saveData` | the user wants to save data |
 * | `connection` | the connection is slower than `slowest`, or there is none |
 */
export type Exclusion =
  | "address"
  | "origin"
  | "here"
  | "download"
  | "attribute"
  | "ignore"
  | "target"
  | "rel"
  | "action"
  | "file"
  | "unsafe"
  | "saveData"
  | "connection";

/** What is not to be loaded: addresses that match, links that a selector matches, links for which a function returns `true`. */
export type Ignore = RegExp | string | ((url: URL, link: Element) => boolean);

/** The types of connections as `navigator.connection.effectiveType` has them. */
export type ConnectionType = "slow-2g" | "2g" | "3g" | "4g";

/** A request that is made ahead: what `onPrefetch` gets, and a function that is the `mechanism`. */
export interface Prefetch {
  /** The address, with its fragment. */
  readonly url: string;
  readonly link: Element;
  readonly mechanism: Mechanism;
  /** Why the link was taken to be meant. */
  readonly reason: Reason;
  /** The posterior probability then; 0 where no pointer moved. */
  readonly probability: number;
  /** Aborts when the request is taken back. */
  readonly signal: AbortSignal;
}

/** What `links` takes: its own options, and those of `watch` that are not about callbacks for intents. */
export interface LinksOptions extends Omit<WatchOptions<Element>, "onIntent" | "onRelease" | "limit"> {
  /** The probability at which a link is loaded, by the rule of `watch`. @defaultValue 0.9 */
  readonly threshold?: number | undefined;
  /** Which elements are watched: live. @defaultValue "a[href], area[href]" */
  readonly selector?: string | undefined;
  /** What is not to be loaded. @defaultValue nothing more than the rules exclude */
  readonly ignore?: Ignore | readonly Ignore[] | undefined;
  /**
   * What is unsafe to ask for: tested against path and query, decoded, in lower case, `logOut` as `log-out`. `null`: nothing is.
   * @defaultValue the rule of docs/links.md
   */
  readonly unsafe?: RegExp | null | undefined;
  /** Further origins whose documents are loaded, such as `"https://docs.example.com"`; `"*"`: all. @defaultValue none */
  readonly origins?: readonly string[] | undefined;
  /** The slowest connection on which something is loaded, where the browser states it. @defaultValue "3g" */
  readonly slowest?: ConnectionType | undefined;
  /**
   * The most requests that run at a time, that begin in a minute, and that begin at all.
   * @defaultValue `{ running: 2, perMinute: 30 }`
   */
  readonly limit?:
    | { readonly running?: number | undefined; readonly perMinute?: number | undefined; readonly total?: number | undefined }
    | undefined;
  /**
   * The mechanism to begin with: where it is missing, the next one of `rules`, `link`, `fetch`. A function loads in its own way, such as a
   * router's; a promise that it returns is fulfilled when that is done.
   * @defaultValue "rules"
   */
  readonly mechanism?: Exclude<Mechanism, "own"> | ((request: Prefetch) => unknown) | undefined;
  /**
   * Whether a document that speculation rules have fetched is prerendered too: its scripts run before the user is there. `true`: once its
   * probability is .95.
   * @defaultValue false
   */
  readonly prerender?: boolean | { readonly threshold: number } | undefined;
  /**
   * Milliseconds after which what a speculation rule asked for is taken to be there, since no browser reports it. Before, the request is
   * cancelled when the pointer turns away; after, the document is kept.
   * @defaultValue 1000
   */
  readonly keep?: number | undefined;
  /** Milliseconds after which a document that was loaded may be asked for again. @defaultValue 300000, as long as Chromium keeps it */
  readonly lifetime?: number | undefined;
  /** The nonce of the scripts with speculation rules. @defaultValue that of the page's first script that has one */
  readonly nonce?: string | undefined;
  /** The tag of the speculation rules, which their requests have in `Sec-Speculation-Tags`. @defaultValue none */
  readonly tag?: string | undefined;
  /** What answers are expected to have as `No-Vary-Search`, in speculation rules. @defaultValue nothing */
  readonly noVarySearch?: string | undefined;
  /** A request begins. */
  readonly onPrefetch?: ((request: Prefetch) => void) | undefined;
  /**
   * What went wrong, and with `link`, `fetch` and `own` each request that failed.
   * @defaultValue errors of callbacks and of the core are reported as uncaught errors, once each; requests that failed are only counted
   */
  readonly onError?: ((error: unknown) => void) | undefined;
}

/**
 * What came of the requests so far: `requested` is `used + wasted + cancelled + failed + running`.
 */
export interface LinksStats {
  /** Requests that began. */
  readonly requested: number;
  /** Early and used: a link to the address was clicked after the request had begun. */
  readonly used: number;
  /** Early and wasted: done, and the user has turned away; a later click makes it used. */
  readonly wasted: number;
  /** Taken back before they were done. */
  readonly cancelled: number;
  /** Answered with an error, or not at all, where that is known: not with speculation rules. */
  readonly failed: number;
  /** On their way, or of a link that is meant now. */
  readonly running: number;
  /** Documents that were prerendered, too. */
  readonly prerendered: number;
  /** Milliseconds from request to click, the median over those used; null where there is none. */
  readonly lead: number | null;
}

/** What {@link links} returns. */
export interface Links {
  /** The watcher of the links: its posterior, its ledger, `refresh`, `pause` and `resume`. */
  readonly watcher: Watcher<Element>;
  /** What came of the requests so far. */
  stats(): LinksStats;
  /** Why a link would not be loaded now, apart from limits; null if it would. */
  excluded(link: Element): Exclusion | null;
  /** Stops for good: what is on its way is taken back, nothing is left on the page. */
  stop(): void;
  /** As {@link stop}, at the end of a `using` declaration's block. */
  [Symbol.dispose](): void;
}
