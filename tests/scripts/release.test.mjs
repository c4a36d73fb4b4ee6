import assert from "node:assert/strict";
import { readFileSync } from "node:fs";
import { join } from "node:path";
import { describe, it } from "node:test";
import { crateWith, npmWith } from "../../scripts/release.mjs";
import { capture, root } from "../../scripts/run.mjs";

const ADDRESS = "https://example.org/owner/whither";
const read = (name) => readFileSync(join(root, name), "utf8");

describe("the repository's address", () => {
  it("is written into the manifest of npm, once, and nothing else is changed", () => {
    const once = npmWith(read("package.json"), "https://example.org/other/name");
    const twice = npmWith(once, ADDRESS);
    const { homepage, repository, bugs, ...rest } = JSON.parse(twice);
    assert.deepEqual([homepage, repository.url, bugs.url], [ADDRESS, `git+${ADDRESS}.git`, `${ADDRESS}/issues`]);
    const before = JSON.parse(read("package.json"));
    for (const key of ["homepage", "repository", "bugs"]) delete before[key];
    assert.deepEqual(rest, before);
  });

  it("is written into the manifests of both crates, once, and nothing else is changed", () => {
    for (const name of ["Cargo.toml", "kernel/Cargo.toml"]) {
      const lines = crateWith(crateWith(read(name), "https://example.org/other/name"), ADDRESS).split("\n");
      const added = [`homepage = "${ADDRESS}"`, `repository = "${ADDRESS}"`];
      assert.deepEqual(
        lines.filter((line) => /^(homepage|repository) = /.test(line)),
        added,
      );
      const others = (text) => text.filter((line) => !/^(homepage|repository) = /.test(line));
      assert.deepEqual(others(lines), others(read(name).split("\n")));
    }
  });

  it("that is none is refused, by its name and its value", async () => {
    const { code, output } = await capture("node", ["scripts/release.mjs", "--repository", "git@example.org:whither.git"]);
    assert.equal(code, 1);
    assert.match(output, /--repository is "git@example\.org:whither\.git": it must be as https:/);
  });
});
