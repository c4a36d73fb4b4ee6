// `npm run docs`: the documentation, served beside the demo.
import { buildDemo, buildDocs, folder } from "./build-demo.mjs";
import { main } from "./run.mjs";
import { serve, wantedPort } from "./serve.mjs";

await main(import.meta.url, async () => {
  await buildDemo();
  await buildDocs();
  const { url } = await serve(folder, { port: wantedPort() });
  console.log(`\nThe documentation is at ${url}docs/ (Ctrl+C stops it)`);
});
