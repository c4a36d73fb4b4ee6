// The page's own logic: www/**/*.test.ts.
import { runUnits } from "../units.mjs";

await runUnits("www");
