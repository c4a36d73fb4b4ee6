// A plugin of TypeDoc: the titles and groups of the documents, which GitHub would show as front matter; and the way to the demo.
import { Application, Converter, PageEvent } from "typedoc";

/** Every document of docs/, in reading order, by group: its file's name and its title. */
export const GROUPS = {
  "On a page": {
    dom: "Elements that know they are meant",
    react: "React",
    frameworks: "Vue, Svelte, Solid, Angular, custom elements",
    links: "Pages that are there before the click",
    menu: "Menus that stay open",
    drawing: "If you draw yourself",
    overlay: "The overlay",
    testing: "A hand for tests",
    foresight: "For users of ForesightJS",
  },
  "Anything that moves": {
    scenarios: "Any motion, any destination",
    "rays-and-hands": "Rays and hands",
    "hand-tracking": "A hand tracker in front of a screen",
    learning: "Learning from recorded movements",
    platforms: "Where it runs",
    errors: "Errors",
    "other-ways": "Beside other ways",
    privacy: "Privacy, and people",
  },
  "What was measured": {
    accuracy: "In one page",
    comparing: "Compare predictors on your data",
    pointing: "The pointing model",
    performance: "What it costs",
    papers: "The papers, errata, patents",
  },
};

/** Stands for the address of the demo until the depth of a page is known. */
const DEMO = "https://demo.invalid/";

export function load(application) {
  application.on(Application.EVENT_BOOTSTRAP_END, ({ options }) => options.setValue("navigationLinks", { Demo: DEMO }));
  application.renderer.on(PageEvent.END, (page) => {
    const depth = page.url.split("/").length;
    page.contents = page.contents.replaceAll(DEMO, `${"../".repeat(depth)}index.html`);
  });
  application.converter.on(Converter.EVENT_CREATE_DOCUMENT, (_context, document) => {
    for (const [group, titles] of Object.entries(GROUPS)) {
      const title = titles[document.name];
      if (title === undefined) continue;
      document.name = title;
      document.frontmatter.group = group;
      return;
    }
    throw new Error(`docs/${document.name}.md has no title in scripts/documents.mjs`);
  });
}
