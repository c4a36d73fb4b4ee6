/**
 * What the entries with all methods export besides their own `init`.
 *
 * @module
 */
export * from "./predicting.js";
export { ConditionallyMarkovSequence, type GivenSequence, type SequenceParameters, type StepModel } from "./sequence.js";
