// The theme, before anything is painted: what the visitor chose, else what their system prefers, else dark. Buttons are in view/theme.ts.
(() => {
  const system = matchMedia("(prefers-color-scheme: light)");
  const apply = () => {
    let chosen = null;
    try {
      chosen = localStorage.getItem("whither-theme");
    } catch {
      // storage may be forbidden: then the choice lasts as long as the page
    }
    const theme = ["light", "dark"].includes(chosen) ? chosen : system.matches ? "light" : "dark";
    if (document.documentElement.dataset.theme === theme) return;
    document.documentElement.dataset.theme = theme;
    dispatchEvent(new Event("themechange"));
  };
  apply();
  system.addEventListener("change", apply);
})();
