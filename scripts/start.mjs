// `npm start`: everything that it takes to see the page.
import { buildDemo, folder } from "./build-demo.mjs";
import { Failure, main } from "./run.mjs";
import { serve } from "./serve.mjs";

await main(import.meta.url, async () => {
  const port = Number(process.env.PORT ?? 8080);
  if (!Number.isInteger(port) || port < 0 || port > 65535) {
    throw new Failure(`PORT is ${JSON.stringify(process.env.PORT)}: it must be a number from 0 to 65535`);
  }
  // A taken port is told now, not after the build.
  await (await serve(folder, { port })).close();
  await buildDemo();
  const { url } = await serve(folder, { port });
  console.log(`\nThe page is at ${url} (Ctrl+C ends it)`);
});
