// The rules of whither/links without a browser: js/links/*.test.ts.
import { runUnits } from "../units.mjs";

await runUnits("js/links");
