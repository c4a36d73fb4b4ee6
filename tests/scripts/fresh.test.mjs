// A checkout that has nothing installed yet: the commands start there, since installing is their own first step.
import { test } from "node:test";
import assert from "node:assert/strict";
import { spawnSync } from "node:child_process";
import { cpSync, mkdtempSync, readFileSync, rmSync } from "node:fs";
import { tmpdir } from "node:os";
import { join } from "node:path";
import { root } from "../../scripts/run.mjs";

test("each command's program loads where no package is installed", (t) => {
  const folder = mkdtempSync(join(tmpdir(), "whither-fresh-"));
  t.after(() => rmSync(folder, { recursive: true, force: true }));
  for (const name of ["package.json", "scripts", "benches", "tests", "www", "js"])
    cpSync(join(root, name), join(folder, name), { recursive: true });
  const { scripts } = JSON.parse(readFileSync(join(folder, "package.json"), "utf8"));
  const programs = new Set(Object.values(scripts).flatMap((command) => command.match(/(?<=^node )\S+/)?.[0] ?? []));
  assert.ok(programs.size > 5 && programs.has("scripts/test.mjs"), "this test no longer finds the commands");
  for (const program of programs) {
    // imported, and therefore not started
    const importing = ["--input-type=module", "--eval", `await import("./${program}")`];
    const { status, stderr } = spawnSync(process.execPath, importing, { cwd: folder, encoding: "utf8" });
    assert.equal(status, 0, `${program}: ${stderr}`);
  }
});
