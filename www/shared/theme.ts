/** The theme's button. What the theme is before that, `public/theme.js` decides before the first paint. */

/** Where the visitor's choice is kept, on their own machine. */
const KEY = "whither-theme";

export function theme(button: HTMLButtonElement, changed: () => void): void {
  const { dataset } = document.documentElement;
  const show = () => button.setAttribute("aria-pressed", String(dataset["theme"] === "light"));
  show();
  addEventListener("themechange", () => {
    show();
    changed();
  });
  matchMedia("(forced-colors: active)").addEventListener("change", changed);
  button.addEventListener("click", () => {
    dataset["theme"] = dataset["theme"] === "light" ? "dark" : "light";
    store(dataset["theme"]);
    dispatchEvent(new Event("themechange"));
  });
}

/** Storage may be forbidden: then the choice lasts as long as the page. */
function store(value: string): void {
  try {
    localStorage.setItem(KEY, value);
  } catch {
    return;
  }
}
