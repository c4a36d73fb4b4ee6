// The rooms of whither/dom without a browser: js/dom/**/*.test.ts.
import { runUnits } from "../units.mjs";

await runUnits("js/dom");
