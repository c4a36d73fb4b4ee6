// What `npm test` counts: by the runners' own output, on tests that pass, fail and are left out in every way.
import { test } from "node:test";
import assert from "node:assert/strict";
import { mkdirSync, mkdtempSync, rmSync, writeFileSync } from "node:fs";
import { tmpdir } from "node:os";
import { join } from "node:path";
import { countCargo, countNode, inWords, nodeArguments } from "../../scripts/count.mjs";
import { capture } from "../../scripts/run.mjs";

function folder(t, files) {
  const path = mkdtempSync(join(tmpdir(), "whither-count-"));
  t.after(() => rmSync(path, { recursive: true, force: true }));
  for (const [name, text] of Object.entries(files)) {
    mkdirSync(join(path, name, ".."), { recursive: true });
    writeFileSync(join(path, name), text);
  }
  return path;
}

async function node(t, text) {
  const cwd = folder(t, { "some.test.mjs": `import { after, before, describe, it, test } from "node:test";\n${text}` });
  // what runs here is itself run by a test runner, which would take the other's tests for its own
  const { code, output } = await capture("node", nodeArguments(["some.test.mjs"]), {
    cwd,
    env: { NODE_TEST_CONTEXT: undefined },
  });
  return { code, counts: inWords(countNode(output)), output };
}

test("a group that is left out is counted, and so are a test, a part of a test and one to be written", async (t) => {
  const { counts, output } = await node(
    t,
    `describe("left out", { skip: "no recordings" }, () => { it("a", () => {}); it("b", () => {}); });
     describe.skip("left out without a reason", () => { it("a", () => {}); });
     describe("run", () => { it("passes", () => {}); it("is left out", { skip: true }, () => {}); });
     test("has parts", async (t) => { await t.test("passes", () => {}); await t.test("left out", (t) => t.skip("")); });
     test("fails", () => { throw new Error("on purpose"); });
     test("to be written", { todo: true }, () => {});`,
  );
  assert.equal(counts, "3 passed, 2 failed, 4 skipped");
  assert.match(output, /no recordings/);
});

test("all that pass are counted as passed", async (t) => {
  const { code, counts } = await node(t, `test("one", () => {}); describe("group", () => { it("two", () => {}); });`);
  assert.deepEqual([code, counts], [0, "2 passed, 0 failed, 0 skipped"]);
});

test("of cargo's tests those that are ignored are counted as left out, in documentation too", async (t) => {
  const lib = `//! \`\`\`ignore
//! left_out();
//! \`\`\`
#[test]
fn passes() {}
#[test]
#[ignore]
fn left_out() {}
`;
  const manifest = '[package]\nname = "counted"\nedition = "2024"\n[workspace]\n';
  const cwd = folder(t, { "Cargo.toml": manifest, "src/lib.rs": lib });
  const { output } = await capture("cargo", ["test", "--offline"], { cwd });
  assert.equal(inWords(countCargo(output)), "1 passed, 0 failed, 2 skipped", output);
});
