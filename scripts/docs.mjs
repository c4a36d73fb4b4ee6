// `npm run docs`: docs/api, the pages of the JavaScript interface, from the comments in js/. A warning is an error.
import { build } from "./build.mjs";
import { main, run } from "./run.mjs";
import { during } from "./stage.mjs";

await main(import.meta.url, async () => {
  await build();
  await during("writing the pages", () => run("node", ["node_modules/typedoc/bin/typedoc", "--options", "typedoc.json"]));
});
