// The recipes of docs/frameworks.md, each compiled by its framework's own compiler, under Chromium's mouse.
import assert from "node:assert/strict";
import { readdirSync, readFileSync } from "node:fs";
import { readFile } from "node:fs/promises";
import { createRequire } from "node:module";
import { describe, it } from "node:test";
import { join } from "node:path";
import { root } from "../../scripts/run.mjs";
import { bundle, folder, hosted, inNode, middle, open, REST, reach } from "./support.mjs";

const recipes = join(root, "examples/frameworks");

/** The frameworks' compilers, from where they are installed. */
const installed = createRequire(join(folder, "package.json"));

/** A plugin of the bundler that compiles files of a kind. */
const compiled = (filter, compile, loader = "js") => ({
  name: String(filter),
  setup({ onLoad }) {
    onLoad({ filter }, async ({ path }) => ({ contents: await compile(await readFile(path, "utf8"), path), loader }));
  },
});

const vue = compiled(/\.vue$/, (source, filename) => {
  const { parse, compileScript } = installed("vue/compiler-sfc");
  return compileScript(parse(source, { filename }).descriptor, { id: "app", inlineTemplate: true }).content;
});

const svelte = (generate) =>
  compiled(/\.svelte$/, (source, filename) => {
    const { compile } = installed("svelte/compiler");
    const { js, warnings } = compile(source, { filename, generate });
    assert.deepEqual(warnings, []);
    return js.code;
  });

const solid = (generate) =>
  compiled(/\.jsx$/, async (source, filename) => {
    const presets = [[installed("babel-preset-solid"), { generate }]];
    const { code } = await installed("@babel/core").transformAsync(source, {
      filename,
      presets,
      configFile: false,
      babelrc: false,
    });
    return code;
  });

/** How each is mounted, and what its bundler needs. */
const frameworks = {
  vue: {
    main: `import { createApp } from "vue";
      import App from "${recipes}/vue/App.vue";
      createApp(App).mount("#root");`,
    options: {
      plugins: [vue],
      define: {
        "process.env.NODE_ENV": '"production"',
        __VUE_OPTIONS_API__: "false",
        __VUE_PROD_DEVTOOLS__: "false",
        __VUE_PROD_HYDRATION_MISMATCH_DETAILS__: "false",
      },
    },
  },
  svelte: {
    main: `import { mount } from "svelte";
      import App from "${recipes}/svelte/App.svelte";
      mount(App, { target: document.getElementById("root") });`,
    options: { plugins: [svelte("client")], conditions: ["browser", "svelte"] },
  },
  solid: {
    main: `import { render } from "solid-js/web";
      import { App } from "${recipes}/solid/App.jsx";
      render(App, document.getElementById("root"));`,
    options: { plugins: [solid("dom")], conditions: ["browser"] },
  },
  angular: {
    main: `import "@angular/compiler";
      import { provideZonelessChangeDetection } from "@angular/core";
      import { bootstrapApplication } from "@angular/platform-browser";
      import { App } from "${recipes}/angular/app.ts";
      document.getElementById("root").append(document.createElement("app-ports"));
      await bootstrapApplication(App, { providers: [provideZonelessChangeDetection()] });`,
    options: { tsconfigRaw: { compilerOptions: { experimentalDecorators: true, useDefineForClassFields: false } } },
  },
  element: {
    main: `import { PortLink } from "${recipes}/element/port-link.js";
      customElements.define("port-link", PortLink);
      const list = document.createElement("nav");
      const show = (ports) => list.replaceChildren(...ports.map((port) => Object.assign(document.createElement("port-link"), { textContent: port })));
      show(["Cowes", "Ryde", "Yarmouth"]);
      const others = Object.assign(document.createElement("button"), { textContent: "Others", onclick: () => show(["Bembridge", "Cowes"]) });
      const output = document.createElement("output");
      const update = () => {
        output.textContent = list.querySelector(":state(next)")?.textContent ?? "none";
        requestAnimationFrame(update);
      };
      update();
      document.getElementById("root").append(list, others, output);`,
  },
};

const style = `<style>
  nav > * { position: absolute; left: 80px; top: 80px; width: 80px; height: 60px; background: #ddd }
  nav > :nth-child(2) { left: 840px } nav > :nth-child(3) { top: 560px }
  button { position: absolute; left: 450px; top: 620px; width: 100px; height: 40px }
</style>`;

describe("the recipes", { concurrency: 2 }, () => {
  const site = hosted();

  it("are in the documentation word for word", () => {
    const text = readFileSync(join(root, "docs/frameworks.md"), "utf8");
    const names = readdirSync(recipes, { recursive: true }).filter((name) => /\.\w+$/.test(name));
    assert.equal(names.length, 10);
    for (const name of names) {
      const extension = name.split(".").at(-1);
      const source = readFileSync(join(recipes, name), "utf8").trim();
      assert.ok(text.includes(`\`\`\`${extension}\n${source}\n\`\`\``), name);
    }
  });

  for (const [name, { main, options }] of Object.entries(frameworks)) {
    it(`${name}: what the mouse is on its way to is meant, what is inserted later too, and nothing that is gone`, async (t) => {
      const program = `${main}
        import { watcher } from "${recipes}/intents.js";
        window.watcher = watcher;`;
      const { page, hand } = await open(t, site, await bundle(program, options), { head: style });
      const shows = (text) =>
        page.waitForFunction((text) => document.querySelector("output")?.textContent === text, text, { timeout: 5000 });
      const places = () => Promise.all([1, 2, 3].map((n) => middle(page, `nav > :nth-child(${n})`)));
      await shows("none");
      const [first, second, third] = await places();
      await page.evaluate(() => {
        window.reasons = [];
        addEventListener("whither:intent", ({ detail }) => reasons.push(detail.reason));
      });
      await hand.play([
        [0, first.x, first.y],
        [0.02, first.x + 2, first.y],
      ]);
      await page.evaluate(() => watcher.ready);
      await reach(page, hand, first, second);
      await shows("Ryde");
      await reach(page, hand, second, { x: 300, y: 650, size: 40 });
      await shows("none");
      await page.locator("button").click();
      await page.waitForFunction(() => document.querySelector("nav").textContent.replace(/\s/g, "") === "BembridgeCowes");
      await reach(page, hand, second, first);
      await shows("Bembridge");
      await reach(page, hand, first, third);
      await hand.rest(REST);
      await shows("none");
      assert.equal(await page.locator("[data-intent]").count(), 2);
      assert.ok((await page.evaluate(() => reasons)).includes("pointer"), "before the mouse was over it");
    });
  }

  it("are rendered on a server, where nothing is watched: Vue, Svelte, Solid", async () => {
    const rendered = async (main, options) => (await inNode(`${main}\n`, options)).default;
    const pages = {
      vue: await rendered(
        `import { createSSRApp } from "vue";
        import { renderToString } from "vue/server-renderer";
        import App from "${recipes}/vue/App.vue";
        export default await renderToString(createSSRApp(App));`,
        frameworks.vue.options,
      ),
      svelte: await rendered(
        `import { render } from "svelte/server";
        import App from "${recipes}/svelte/App.svelte";
        export default render(App).body;`,
        { plugins: [svelte("server")] },
      ),
      solid: await rendered(
        `import { renderToString } from "solid-js/web";
        import { App } from "${recipes}/solid/App.jsx";
        export default renderToString(() => App());`,
        { plugins: [solid("ssr")] },
      ),
    };
    for (const [name, html] of Object.entries(pages)) {
      const text = html.replace(/<[^>]*>/g, "").replace(/\s+/g, "");
      assert.equal(text, "CowesRydeYarmouthOthersnone", `${name}: ${html}`);
      assert.doesNotMatch(html, /data-intent/);
    }
  });
});
