// The parts of whither/react that know no React: js/react/**/*.test.ts.
import { runUnits } from "../units.mjs";

await runUnits("js/react");
