import assert from "node:assert/strict";
import { describe, it } from "node:test";
import { overlay } from "./overlay.js";
import { readOptions, readWatchers } from "./options.js";

const error = (run: () => unknown) => {
  try {
    run();
  } catch (error) {
    const { name, code, path, message } = error as Error & { code: string; path: string };
    return [name, code, path, message];
  }
  return null;
};
const watcher = { getSnapshot: () => null };

describe("options of an overlay", () => {
  it("have defaults", () => {
    const { shortcut, ...others } = readOptions(undefined);
    assert.deepEqual(others, { theme: "auto", collapsed: undefined, signal: null });
    assert.equal(shortcut?.text, "Alt+Shift+W");
    assert.equal(readOptions({ shortcut: null }).shortcut, null);
    assert.equal(readOptions({ shortcut: undefined, theme: undefined }).shortcut?.text, "Alt+Shift+W");
  });

  it("are refused with the path and the value", () => {
    const refused = [
      [{ colour: 1 }, "unknown-key", 'colour: unknown key "colour", expected one of "theme", "collapsed", "shortcut", "signal"'],
      [{ theme: "blue" }, "out-of-range", 'theme: must be one of auto, dark, light, got "blue"'],
      [{ collapsed: 1 }, "wrong-type", "collapsed: must be a boolean, got 1"],
      [{ signal: {} }, "wrong-type", "signal: must be an AbortSignal, got an object"],
      [{ shortcut: 3 }, "wrong-type", "shortcut: must be a string, got 3"],
      ...["W", "Alt+", "Alt+Hyper+W", "Alt+Enter", "Alt+Shift"].map((shortcut) => [
        { shortcut },
        "out-of-range",
        `shortcut: must be some of Alt, Ctrl, Meta, Shift and a letter or digit, joined by +, got "${shortcut}"`,
      ]),
    ] as const;
    for (const [options, code, message] of refused) {
      assert.deepEqual(
        error(() => readOptions(options)),
        ["WhitherError", code, Object.keys(options)[0], message],
      );
    }
    assert.deepEqual(
      error(() => readOptions(3)),
      ["WhitherError", "wrong-type", "options", "options: must be an object, got 3"],
    );
  });

  it("match the key's place on the keyboard with exactly its modifiers", () => {
    const { shortcut } = readOptions({ shortcut: "Alt+Shift+w" });
    const event = { code: "KeyW", key: "„", altKey: true, ctrlKey: false, metaKey: false, shiftKey: true };
    const matches = (other: object) => shortcut?.matches({ ...event, ...other } as KeyboardEvent);
    assert.equal(matches({}), true);
    for (const other of [{ ctrlKey: true }, { metaKey: true }, { shiftKey: false }, { altKey: false }, { code: "KeyV" }]) {
      assert.equal(matches(other), false, JSON.stringify(other));
    }
    const digit = readOptions({ shortcut: "Ctrl+0" }).shortcut;
    assert.equal(
      digit?.matches({ ...event, code: "Digit0", altKey: false, shiftKey: false, ctrlKey: true } as KeyboardEvent),
      true,
    );
  });
});

describe("watchers of an overlay", () => {
  it("are one, several, or those of the page", () => {
    assert.equal(readWatchers(undefined), null);
    assert.equal(readWatchers(null), null);
    assert.deepEqual(readWatchers(watcher), [watcher]);
    assert.deepEqual(readWatchers(new Set([watcher])), [watcher]);
    assert.deepEqual(readWatchers([]), []);
  });

  it("are refused with their place", () => {
    assert.deepEqual(
      error(() => readWatchers("nav a")),
      ["WhitherError", "wrong-type", "watchers", 'watchers: must be a watcher, got "nav a"'],
    );
    assert.deepEqual(
      error(() => overlay([watcher, 3] as never)),
      ["WhitherError", "wrong-type", "watchers[1]", "watchers[1]: must be a watcher, got 3"],
    );
  });

  it("are not drawn on a server, where nothing happens", () => {
    const drawn = overlay(watcher as never, { theme: "dark" });
    drawn.show();
    drawn.hide();
    drawn.close();
    assert.equal(drawn.state, "closed");
  });
});
