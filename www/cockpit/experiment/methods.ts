/** The methods that are compared. */
import type { Scenario } from "whither";
import type { Series } from "../lines.ts";
import { handModel, paperModel } from "../models.ts";

export interface Method {
  readonly id: string;
  readonly name: string;
  /** Null for the rule without a model: the nearest icon. */
  scenario(): Scenario | null;
  /** The id of a method whose probabilities have to be the same. */
  readonly same?: string;
  /** How it is drawn; a method that is the same as another one is on that one's line. */
  readonly line?: Series;
}

/** "None of them" is no icon: it is left out, so that all methods choose from the same 21. */
const NONE = 0;

export const METHODS: readonly Method[] = [
  {
    id: "shake",
    name: "Pointing model, with shake",
    scenario: () => handModel(true, NONE),
    line: { name: "Pointing, with shake", ink: "light", width: 3 },
  },
  {
    id: "pointing",
    name: "Pointing model, without",
    scenario: () => handModel(false, NONE),
    line: { name: "Pointing, without", ink: "light", width: 2, dash: [7, 4] },
  },
  {
    id: "pseudoObservation",
    name: "Pseudo-observation",
    scenario: () => paperModel("pseudoObservation"),
    line: { name: "Algorithms 1 and 2", ink: "text", width: 2 },
  },
  { id: "algorithm1", name: "Algorithm 1 (Liang)", scenario: () => paperModel("algorithm1"), same: "pseudoObservation" },
  { id: "algorithm2", name: "Algorithm 2 (Liang)", scenario: () => paperModel("algorithm2"), same: "pseudoObservation" },
  {
    id: "bridging",
    name: "Bridging",
    scenario: () => paperModel("bridging"),
    line: { name: "Bridging", ink: "text", width: 2, dash: [7, 4] },
  },
  { id: "singleFilter", name: "Single filter (Ardeshiri)", scenario: () => paperModel("singleFilter"), same: "bridging" },
  {
    id: "singleFilterApproximate",
    name: "Single filter, approximate",
    scenario: () => paperModel("singleFilterApproximate"),
    line: { name: "Single, approximate", ink: "rest", width: 2, dash: [2, 3] },
  },
  { id: "nearest", name: "Nearest icon", scenario: () => null, line: { name: "Nearest icon", ink: "rest", width: 1.5 } },
];
