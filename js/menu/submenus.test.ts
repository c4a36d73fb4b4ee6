import assert from "node:assert/strict";
import { describe, it } from "node:test";
import { hide, show } from "./submenus.js";

/** As much of an element as is written on. */
function element(attributes: Record<string, string>, popover = false): Element {
  const all = new Map(Object.entries(attributes));
  let isOpen = false;
  return {
    getAttribute: (name: string) => all.get(name) ?? null,
    hasAttribute: (name: string) => all.has(name),
    setAttribute: (name: string, value: string) => all.set(name, value),
    removeAttribute: (name: string) => all.delete(name),
    matches: () => isOpen,
    ...(popover && {
      showPopover() {
        assert.ok(!isOpen, "it must not be open");
        isOpen = true;
      },
      hidePopover() {
        isOpen = false;
      },
    }),
    get isOpen() {
      return isOpen;
    },
  } as unknown as Element;
}

describe("a submenu that the page does not show itself", () => {
  it("is shown by its attribute, and aria-expanded is as it was before where it was not there", () => {
    const [item, panel] = [element({}), element({ hidden: "" })];
    show({ item, panel });
    assert.deepEqual([panel.hasAttribute("hidden"), item.getAttribute("aria-expanded")], [false, "true"]);
    hide({ item, panel });
    assert.deepEqual([panel.hasAttribute("hidden"), item.getAttribute("aria-expanded")], [true, null]);
    const stated = element({ "aria-expanded": "false" });
    show({ item: stated, panel });
    hide({ item: stated, panel });
    assert.equal(stated.getAttribute("aria-expanded"), "false");
  });

  it("is shown as a popover where it is one, unless it is shown already", () => {
    const [item, panel] = [element({}), element({ popover: "manual" }, true)];
    show({ item, panel });
    show({ item, panel });
    assert.equal((panel as never as { isOpen: boolean }).isOpen, true);
    hide({ item, panel });
    assert.equal((panel as never as { isOpen: boolean }).isOpen, false);
  });
});
