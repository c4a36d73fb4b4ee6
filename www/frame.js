/** What every page has in common, put into its HTML when it is built: `<!-- head -->`, `<!-- header: … -->`, `<!-- footer -->`. */

/** Every page, in the order of the navigation. */
export const PAGES = [
  { path: "index.html", name: "The car" },
  { path: "cockpit/index.html", name: "Cockpit" },
  { path: "bay/index.html", name: "Bay" },
  { path: "lab/index.html", name: "Lab" },
  { path: "sequences/index.html", name: "Sequences" },
];

const FONT = "node_modules/@fontsource-variable/archivo/files/archivo-latin-wdth-normal.woff2";

/** A plugin of Vite. `version`, `license` and `repository` are the package's. */
export function frame({ version, license, repository }) {
  return {
    name: "frame",
    transformIndexHtml: {
      order: "pre",
      handler(html, { path }) {
        const page = path.replace(/^\//, "");
        const up = "../".repeat(page.split("/").length - 1) || "./";
        return html
          .replace("<!-- head -->", head(up))
          .replace(/<!-- header: (.*?) -->/, (_, tagline) => header(page, up, tagline))
          .replace("<!-- footer -->", footer(up, { version, license, repository }));
      },
    },
  };
}

function head(up) {
  return `<meta charset="utf-8" />
    <meta name="viewport" content="width=device-width, initial-scale=1" />
    <script src="/theme.js"></script>
    <meta name="color-scheme" content="dark light" />
    <link rel="preload" href="${up}../${FONT}" as="font" type="font/woff2" crossorigin />
    <link rel="icon" href="${up}favicon.svg" type="image/svg+xml" />`;
}

function header(page, up, tagline) {
  const links = PAGES.map(({ path, name }) => {
    const current = path === page ? ' aria-current="page"' : "";
    return `<a href="${up}${path}"${current}>${name}</a>`;
  });
  return `<header class="header">
      <p class="name"><a id="home" href="${up}index.html">Whither</a></p>
      <p class="tagline">${tagline}</p>
      <nav class="links" aria-label="Scenes">
        ${links.join("\n        ")}
      </nav>
      <button class="theme" id="theme" type="button" aria-pressed="false" aria-label="Light theme">
        <svg viewBox="0 0 24 24" aria-hidden="true"><circle cx="12" cy="12" r="8.25" /><path d="M12 3.75a8.25 8.25 0 0 1 0 16.5z" /></svg>
      </button>
    </header>`;
}

function footer(up, { version, license, repository }) {
  const source = repository ? `<a href="${repository}">Source</a>` : "";
  return `<footer class="footer">
      <p>Whither ${version}, ${license.replace(" OR ", " or ")}. Everything is computed in your browser, and nothing is sent anywhere; once loaded, these pages work offline.</p>
      <p class="footer-links"><a href="${up}docs/index.html">Documentation</a><a href="${up}index.html#papers">Papers and patents</a><a href="${up}licences.md">Licences</a>${source}</p>
    </footer>`;
}
