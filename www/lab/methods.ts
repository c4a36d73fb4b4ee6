/** What is compared, in the order in which equals are listed. */

export type MethodId =
  | "pointing"
  | "pseudoObservation"
  | "algorithm1"
  | "algorithm2"
  | "bridging"
  | "singleFilter"
  | "singleFilterApproximate"
  | "extrapolation"
  | "foresight"
  | "nearest"
  | "predicted";

export interface Method {
  readonly id: MethodId;
  readonly name: string;
  /** What it does, in words. */
  readonly what: string;
}

export const METHODS: readonly Method[] = [
  { id: "pointing", name: "Pointing model", what: "whither’s own: pointerScenario, as shipped" },
  { id: "pseudoObservation", name: "Pseudo-observation", what: "the papers’ exact method in closed form" },
  { id: "algorithm1", name: "Algorithm 1", what: "Liang and others, step by step" },
  { id: "algorithm2", name: "Algorithm 2", what: "the same numbers by another way" },
  { id: "bridging", name: "Bridging distributions", what: "a filter for each target and arrival time" },
  { id: "singleFilter", name: "Single filter", what: "Ardeshiri and others, exact" },
  { id: "singleFilterApproximate", name: "Single filter, approximate", what: "their Table 1" },
  { id: "extrapolation", name: "Linear extrapolation", what: "the best of 24 on these very movements" },
  { id: "foresight", name: "ForesightJS", what: "4.2.1, its own code: 8 samples, 120 ms ahead" },
  { id: "nearest", name: "Nearest target", what: "to where the pointer is" },
  { id: "predicted", name: "getPredictedEvents", what: "the browser’s own: nearest to where it expects the pointer" },
];

export function methodOf(id: MethodId): Method {
  const found = METHODS.find((method) => method.id === id);
  if (!found) throw new Error(`no method ${id}`);
  return found;
}
