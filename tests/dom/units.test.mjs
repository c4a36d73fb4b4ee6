// The rooms of whither/dom and of what is beside it, without a browser: their **/*.test.ts.
import { runUnits } from "../units.mjs";

for (const folder of ["js/dom", "js/links", "js/menu", "js/overlay", "js/testing"]) await runUnits(folder);
