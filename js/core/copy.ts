import { WhitherError } from "#error";

/** Copies numbers, into an array of as many where one is given. */
export function copyInto(numbers: Float64Array, into: Float64Array | undefined): Float64Array {
  if (into === undefined) return numbers.slice();
  if (!ArrayBuffer.isView(into) || into[Symbol.toStringTag] !== "Float64Array") {
    throw new WhitherError("wrong-type", "into", "must be a Float64Array");
  }
  if (into.length !== numbers.length) {
    throw new WhitherError("wrong-length", "into", `must have ${numbers.length} numbers, has ${into.length}`);
  }
  into.set(numbers);
  return into;
}
