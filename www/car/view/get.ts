/** How to get it: the line that installs it, with a button that copies it, and what the build measured. */
import { installLine } from "../../shared/install.ts";
import { part } from "../../shared/page.ts";

/** Milliseconds for which the button states that it has copied. */
const COPIED = 2000;

export function get(): void {
  const line = part("install");
  const copy = part<HTMLButtonElement>("copy");
  line.textContent = installLine();
  const { dom, later, license, repository } = __WHITHER__;
  const kB = (bytes: number) => `${(bytes / 1000).toFixed(1)} kB`;
  part("particulars").textContent =
    `${kB(dom)} with your page, ${kB(later)} once a pointer moves, under gzip. ${license.replace(" OR ", " or ")}.`;
  if (repository) {
    const source = document.createElement("a");
    source.href = repository;
    source.textContent = "Source";
    part("on-page").append(source);
  }
  copy.addEventListener("click", () => {
    const named = copy.textContent;
    const answer = (text: string) => {
      copy.textContent = text;
      setTimeout(() => (copy.textContent = named), COPIED);
    };
    navigator.clipboard.writeText(line.textContent).then(
      () => answer("Copied"),
      () => {
        // where a page may not write to the clipboard, the line is selected, for who copies it by hand
        getSelection()?.selectAllChildren(line);
        answer("Selected");
      },
    );
  });
}
