/** Dark first; a visitor's choice is kept on their own machine. */

const KEY = "whither-theme";

export function theme(button: HTMLButtonElement, changed: () => void): void {
  const apply = (light: boolean) => {
    document.documentElement.dataset["theme"] = light ? "light" : "dark";
    button.setAttribute("aria-pressed", String(light));
  };
  apply(stored() === "light");
  button.addEventListener("click", () => {
    const light = button.getAttribute("aria-pressed") !== "true";
    apply(light);
    store(light ? "light" : "dark");
    changed();
  });
}

/** Storage may be forbidden: then the choice lasts as long as the page. */
function stored(): string | null {
  try {
    return localStorage.getItem(KEY);
  } catch {
    return null;
  }
}

function store(value: string): void {
  try {
    localStorage.setItem(KEY, value);
  } catch {
    return;
  }
}
