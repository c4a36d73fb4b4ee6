// `npm start`: everything that it takes to open the page.
import { buildDemo, buildDocs, folder } from "./build-demo.mjs";
import { main } from "./run.mjs";
import { serve, wantedPort } from "./serve.mjs";

await main(import.meta.url, async () => {
  const port = wantedPort();
  // A taken port is an error now, not after the build.
  await (await serve(folder, { port })).close();
  await buildDemo();
  const { url } = await serve(folder, { port });
  console.log(`\nThe demo is at ${url} (Ctrl+C stops it)`);
  await buildDocs();
  console.log(`The documentation is at ${url}docs/`);
});
