/**
 * The `handleClose` of floating-ui's `useHover`.
 *
 * @module
 */
import { isShown } from "./boxes.js";
import { Hold } from "./hold.js";
import { type HandleCloseSettings, readHandleClose } from "./options.js";
import { browser, type Platform } from "./platform.js";
import type { HoldOptions } from "./types.js";

/** What {@link handleClose} takes. */
export interface HandleCloseOptions extends HoldOptions {
  /**
   * Whether nothing else on the page gets pointer events while the panel is open, so that the siblings of a menu's item do not open theirs:
   * as that option of `safePolygon`.
   *
   * @defaultValue false
   */
  readonly blockPointerEvents?: boolean | undefined;
}

/** What `useHover` gives its `handleClose`, as far as it is used here. */
export interface HandleCloseContext {
  readonly x: number | null;
  readonly y: number | null;
  readonly elements: { readonly domReference?: Element | null; readonly floating?: Element | null };
  readonly nodeId?: string | undefined;
  readonly tree?:
    | {
        readonly nodesRef: {
          readonly current: readonly {
            readonly parentId: string | null;
            readonly context?: { readonly open: boolean } | undefined;
          }[];
        };
      }
    | null
    | undefined;
  /** Closes the floating element. */
  onClose(): void;
}

/** What {@link handleClose} returns, to be given to `useHover`. */
export interface HandleClose {
  (context: HandleCloseContext): (event: MouseEvent) => void;
  readonly __options: { readonly blockPointerEvents: boolean };
}

/** What is held of each floating element, whichever render asked for it. */
interface Held {
  readonly hold: Hold;
  readonly reference: Element;
  /** What `useHover` gave last. */
  context: HandleCloseContext;
  settings: HandleCloseSettings;
}

let held: WeakMap<Element, Held> | undefined;

/** Whether the core has been asked for. */
let asked = false;

/**
 * For `useHover` of `@floating-ui/react`, in place of its `safePolygon()`: keeps the floating element open while the pointer is on its way to it.
 *
 * @throws {@link WhitherError} for an unknown option and a value that is not legal.
 *
 * @example
 * ```ts
 * const hover = { handleClose: handleClose({ blockPointerEvents: true }) }; // useHover(context, hover)
 * ```
 */
export function handleClose(options?: HandleCloseOptions): HandleClose {
  return handleCloseOn(browser(), options);
}

/** As {@link handleClose}, on any platform; null for none. */
export function handleCloseOn(platform: Platform | null, options?: HandleCloseOptions): HandleClose {
  const settings = readHandleClose(options);
  const { blockPointerEvents } = settings;
  if (platform) load(platform);
  const begin = (context: HandleCloseContext) => {
    const { domReference, floating } = context.elements;
    if (!platform || !domReference || !floating) return () => {};
    held ??= new WeakMap();
    let one = held.get(floating);
    // one floating element may have several references, one after another
    if (one?.reference !== domReference) {
      one?.hold.end();
      one = hold(platform, domReference, floating, context, settings);
      held.set(floating, one);
    }
    const current = Object.assign(one, { context, settings });
    return (event: MouseEvent) => take(event, current, floating);
  };
  return Object.assign(begin, { __options: { blockPointerEvents } });
}

/** Loads the core when a mouse or a pen moves for the first time: by the time that it leaves a trigger it is late for that. */
function load(platform: Platform): void {
  if (asked) return;
  asked = true;
  const watcher = platform.watch([], { load: "pointer", pointers: ["mouse", "pen"], onError() {} });
  const stop = () => watcher.stop();
  watcher.ready.then(stop, stop);
}

function hold(
  platform: Platform,
  reference: Element,
  floating: Element,
  context: HandleCloseContext,
  settings: HandleCloseSettings,
): Held {
  const one: Held = {
    reference,
    context,
    settings,
    hold: new Hold(platform, () => one.settings, {
      trigger: reference,
      panels: () => [floating],
      lost() {
        // it may have been closed by something else
        if (isShown(floating) && !hasOpenChild(one.context)) one.context.onClose();
      },
    }),
  };
  return one;
}

/** Takes a `mousemove` of the document, or the `mouseleave` of the reference or the floating element. */
function take(event: MouseEvent, { hold, context, reference }: Held, floating: Element): void {
  const over = event.type === "mouseleave" ? event.relatedTarget : event.composedPath()[0];
  // what opened out of it keeps it open, and closes first
  if (isIn(over, reference) || isIn(over, floating) || hasOpenChild(context)) hold.end();
  else hold.leave(event.clientX, event.clientY);
}

/** Whether a node is in an element, in its shadow trees too. */
function isIn(node: EventTarget | null | undefined, element: Element): boolean {
  for (let at = node as Node | null | undefined; at; at = at.parentNode ?? (at as ShadowRoot).host)
    if (at === element) return true;
  return false;
}

function hasOpenChild({ nodeId, tree }: HandleCloseContext): boolean {
  return tree?.nodesRef.current.some(({ parentId, context }) => parentId === nodeId && context?.open) ?? false;
}
