/**
 * What may have changed on the page since the layout was last read, as far as the browser reports it. Nothing is read here.
 *
 * @module
 */
import type { Listeners, Platform, Stop } from "../platform.js";
import type { Target } from "../targets.js";

export class Changes {
  /** Elements may have moved. */
  moved = true;
  /** Styles and attributes may be others, too. */
  restyled = true;
  /** What is under a resting pointer may be something else. */
  scrolled = false;
  readonly #platform: Platform;
  readonly #changed: () => void;
  readonly #others: Listeners;

  /** `changed` asks for a frame; `others` are further listeners for each window. */
  constructor(platform: Platform, changed: () => void, others: Listeners) {
    this.#platform = platform;
    this.#changed = changed;
    this.#others = others;
  }

  /** Elements may have moved. */
  move(): void {
    this.moved = true;
    this.#changed();
  }

  /** Everything may have changed. */
  outdate(): void {
    this.restyled = true;
    this.move();
  }

  /** Listens to what moves elements and restyles them in a window. */
  listen(view: Window): Stop {
    const resize = () => this.move();
    const scroll = () => {
      this.scrolled = true;
      this.move();
    };
    const restyled = () => this.outdate();
    const { visualViewport } = view;
    const stops = [
      this.#platform.listen(view, {
        resize,
        scroll,
        load: restyled,
        transitionend: restyled,
        animationend: restyled,
        fullscreenchange: restyled,
        ...this.#others,
      }),
      visualViewport && this.#platform.listen(visualViewport, { resize, scroll }),
    ];
    return () => {
      for (const stop of stops) stop?.();
    };
  }

  /**
   * Takes in what was written in style attributes, passing over what watchers, this one or others, wrote there: as of what is
   * animated, only what is in these elements may have another style. Gives whether that is all that has changed.
   */
  restyle(records: readonly MutationRecord[], targets: Iterable<Target>): boolean {
    const own = records.filter((record) => !isDecoration(record));
    if (own.some(({ attributeName }) => attributeName !== "style")) return false;
    if (own.length === 0) return true;
    const nodes = [...new Set(own.map(({ target }) => target))];
    const isIn = (element: Element | null, node: Node) => node.contains(element) || node.getRootNode() !== element?.getRootNode();
    for (const target of targets) if (nodes.some((node) => isIn(target.element, node))) target.styled = false;
    this.move();
    return true;
  }
}

function isDecoration({ attributeName, oldValue, target }: MutationRecord): boolean {
  if (attributeName !== "style") return attributeName === "data-predicted";
  const now = (target as Element).getAttribute("style");
  const other = (style: string | null) => style?.replace(/--probability:[^;]*;?/, "").trim() || null;
  if (other(oldValue) === other(now)) return true;
  // the first time it becomes the text that the browser writes for it
  const scratch = (target.ownerDocument as Document).createElement("i").style;
  const written = (style: string | null) => {
    scratch.cssText = style ?? "";
    scratch.removeProperty("--probability");
    return scratch.cssText;
  };
  return written(oldValue) === written(now);
}
