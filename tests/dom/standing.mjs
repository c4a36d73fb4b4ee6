// Counts what a page listens to, observes and waits for, so that what is left behind shows.

/** Runs in the page before anything else: counts what is listened to, observed and waited for. */
export function count() {
  const listeners = new Map();
  const key = (type, capture) => `${type} ${Boolean(typeof capture === "object" ? capture?.capture : capture)}`;
  const { addEventListener, removeEventListener } = EventTarget.prototype;
  const forget = (target, listener, name) => listeners.get(target)?.get(listener)?.delete(name);
  EventTarget.prototype.addEventListener = function (type, listener, options) {
    const target = this ?? globalThis;
    if (listener && !options?.signal?.aborted) {
      const name = key(type, options);
      const of = listeners.get(target) ?? listeners.set(target, new Map()).get(target);
      const names = of.get(listener) ?? of.set(listener, new Set()).get(listener);
      names.add(name);
      const gone = () => forget(target, listener, name);
      if (options?.signal) addEventListener.call(options.signal, "abort", gone);
      if (options?.once) addEventListener.call(target, type, gone);
      // what is dispatched once to what is gone then
      if (type === "abort") addEventListener.call(target, type, gone);
    }
    return addEventListener.call(target, type, listener, options);
  };
  EventTarget.prototype.removeEventListener = function (type, listener, options) {
    forget(this ?? globalThis, listener, key(type, options));
    return removeEventListener.call(this ?? globalThis, type, listener, options);
  };

  const observers = new Map();
  for (const name of ["ResizeObserver", "IntersectionObserver", "MutationObserver", "PerformanceObserver"]) {
    window[name] = class extends window[name] {
      observe(target, ...more) {
        const of = observers.get(this) ?? observers.set(this, new Set()).get(this);
        of.add(target);
        return super.observe(target, ...more);
      }
      unobserve(target) {
        observers.get(this)?.delete(target);
        return super.unobserve(target);
      }
      disconnect() {
        observers.delete(this);
        return super.disconnect();
      }
    };
  }

  const waiting = new Map();
  for (const [begin, end] of [
    ["requestAnimationFrame", "cancelAnimationFrame"],
    ["setTimeout", "clearTimeout"],
    ["setInterval", "clearInterval"],
    ["requestIdleCallback", "cancelIdleCallback"],
  ]) {
    const [start, cancel] = [window[begin], window[end]];
    waiting.set(begin, new Set());
    window[begin] = (callback, ...more) => {
      const id = start.call(
        window,
        (...given) => {
          if (begin !== "setInterval") waiting.get(begin).delete(id);
          return callback(...given);
        },
        ...more,
      );
      waiting.get(begin).add(id);
      return id;
    };
    window[end] = (id) => {
      waiting.get(begin).delete(id);
      return cancel.call(window, id);
    };
  }

  const sum = (numbers) => [...numbers].reduce((total, each) => total + each, 0);
  window.standing = () => ({
    // those of elements that are on no page go with them
    listeners: sum(
      [...listeners]
        .filter(([target]) => target.isConnected !== false)
        .flatMap(([, of]) => [...of.values()].map((names) => names.size)),
    ),
    observers: sum([...observers.values()].map((targets) => targets.size)),
    waiting: Object.fromEntries([...waiting].map(([name, ids]) => [name, ids.size])),
  });
}
