// How many tests passed, failed and were left out, by the test runners' output; a reporter for Node's, which by itself does
// not count a group that is left out.

/** What each kind of counting begins with. */
const none = () => ({ passed: 0, failed: 0, skipped: 0 });

/** Of what `cargo test` printed. */
export function countCargo(output) {
  const counts = none();
  for (const [, passed, failed, ignored] of output.matchAll(/^test result: .* (\d+) passed; (\d+) failed; (\d+) ignored/gm)) {
    counts.passed += Number(passed);
    counts.failed += Number(failed);
    counts.skipped += Number(ignored);
  }
  return counts;
}

/** The arguments with which Node runs the tests of these files, counted. */
export const nodeArguments = (files) => {
  const reporters = ["spec", new URL(import.meta.url).href].flatMap((name) => [
    `--test-reporter=${name}`,
    "--test-reporter-destination=stdout",
  ]);
  return ["--test", ...reporters, ...files];
};

/** Of what that printed. */
export function countNode(output) {
  const counts = none();
  for (const [, passed, failed, skipped] of output.matchAll(/^counted: (\d+) passed, (\d+) failed, (\d+) skipped$/gm)) {
    counts.passed += Number(passed);
    counts.failed += Number(failed);
    counts.skipped += Number(skipped);
  }
  return counts;
}

/** The same for people. */
export const inWords = ({ passed, failed, skipped }) => `${passed} passed, ${failed} failed, ${skipped} skipped`;

/** The reporter. A group that is left out counts as one test; one that runs is counted by its tests. A test to do has failed. */
export default async function* count(events) {
  const counts = none();
  for await (const { type, data } of events) {
    if (type !== "test:pass" && type !== "test:fail") continue;
    if (given(data.skip)) counts.skipped += 1;
    else if (data.details.type === "suite") continue;
    else counts[type === "test:pass" && !given(data.todo) ? "passed" : "failed"] += 1;
  }
  yield `counted: ${inWords(counts)}\n`;
}

/** Whether a test is marked so: by `true` or by a reason, which may be empty. */
const given = (mark) => mark !== undefined && mark !== false;
