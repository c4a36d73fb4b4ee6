/**
 * The search behind `fit`.
 *
 * @module
 */
import { WhitherError } from "./error.js";
import { __wbg_set_wasm, fit, imports, make_room } from "./generated/study.js";
import { checkOptions } from "./options.js";
import type { Scenario } from "./scenario.js";
import { compiled, type WasmSource } from "./source.js";
import { begin, instantiated } from "./start.js";
import type { FitOptions, Fitted, Track } from "./study.js";
import { plain } from "./value.js";

const side = { __wbg_set_wasm, imports };

let loading: Promise<object> | undefined;

async function load(source: () => WasmSource): Promise<object> {
  return begin(await instantiated(await compiled(source), side), side);
}

/** As `fit` does, with the WebAssembly that `source` gives. */
export async function learn<S extends Omit<Scenario, "destinations">>(
  source: () => WasmSource,
  tracks: readonly Track[],
  scenario: S,
  options: FitOptions | undefined,
): Promise<Fitted<S>> {
  checkOptions(options, ["constants", "evaluations", "destination", "progress"]);
  const { progress, ...others } = options ?? {};
  if (progress !== undefined && typeof progress !== "function") {
    throw new WhitherError("wrong-type", "progress", "must be a function");
  }
  let bytes = 0;
  const given = plain({ ...others, tracks, scenario }, "", (needed) => void (bytes = 2 * needed));
  loading ??= load(source).catch((error: unknown) => {
    loading = undefined;
    throw error;
  });
  await loading;
  if (!make_room(bytes)) {
    throw new WhitherError("too-large", "tracks", `may take ${Math.ceil(bytes / 2 ** 20)} MB of memory, more than there is`);
  }
  let thrown: { readonly error: unknown } | undefined;
  const listener = {
    tell(share: number, loss: number): boolean {
      try {
        return progress?.({ share, loss }) !== false;
      } catch (error) {
        thrown = { error };
        return false;
      }
    },
  };
  const fitted = fit(given, listener) as Fitted<S>;
  if (thrown) throw thrown.error;
  return fitted;
}
