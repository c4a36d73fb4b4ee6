// `npm run docs`: the documentation, served beside the demo.
import { buildDemo, folder } from "./build-demo.mjs";
import { main } from "./run.mjs";
import { serve, wantedPort } from "./serve.mjs";

await main(import.meta.url, async () => {
  await buildDemo();
  const { url } = await serve(folder, { port: wantedPort() });
  console.log(`\nThe documentation is at ${url}docs/ (Ctrl+C stops it)`);
});
