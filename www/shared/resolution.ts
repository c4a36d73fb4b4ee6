/** The device's pixels in one of the page's: zoom changes them, and so does another screen. */

/** Calls back whenever they have changed. */
export function onResolution(changed: () => void): void {
  let ratio = devicePixelRatio;
  const check = () => {
    if (devicePixelRatio === ratio) return;
    ratio = devicePixelRatio;
    watch();
    changed();
  };
  // a query answers once for each resolution; zoom without one comes as a change of size
  const watch = () => matchMedia(`(resolution: ${ratio}dppx)`).addEventListener("change", check, { once: true });
  watch();
  addEventListener("resize", check);
}
