// The rooms of whither/menu without a browser: js/menu/**/*.test.ts.
import { runUnits } from "../units.mjs";

await runUnits("js/menu");
