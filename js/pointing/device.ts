import { fromBytes } from "../core/bytes.js";
import { device_scenario, loaded } from "../core/loading/instance.js";
import { copyIn } from "../core/memory.js";
import type { Scenario } from "../core/scenario.js";

/** The scenario of a kind of device, by its number in `src/wasm/pointer.rs`. */
export function deviceScenario(kind: number, targets: unknown, options: unknown): Scenario {
  loaded();
  return fromBytes(device_scenario(kind, copyIn({ targets, options }, "", 2))) as Scenario;
}
