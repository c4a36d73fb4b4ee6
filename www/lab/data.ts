/** The visitor's own data: kept if they ask for it, forgotten when they ask for it, lines out and in. */
import { download, onFiles, readFiles } from "./files.ts";
import { isKeeping, keep, keepNothing } from "./keep.ts";
import { approachOf, type Movement } from "./movement.ts";
import { count } from "./words.ts";

export interface DataParts {
  readonly keep: HTMLInputElement;
  readonly forget: HTMLButtonElement;
  readonly save: HTMLButtonElement;
  readonly open: HTMLButtonElement;
  readonly file: HTMLInputElement;
  /** What could not be read, line by line. */
  readonly problems: HTMLElement;
}

/** What these controls act on. */
export interface Data {
  /** What is shown. */
  shown(): { readonly movements: readonly Movement[]; readonly name: string };
  own(): readonly Movement[];
  /** Adds to the visitor's own; returns those that were not there. */
  add(movements: readonly Movement[]): readonly Movement[];
  /** Empties the visitor's own. */
  clear(): void;
  write(text: string): void;
}

/** Milliseconds in which a second press forgets. */
const SURE = 4000;

export function dataControls(parts: DataParts, data: Data): void {
  parts.save.addEventListener("click", () => {
    const { movements, name } = data.shown();
    download(movements, `whither-${name}.jsonl`);
    data.write(`Saved ${count(movements.length, "movement")}, one a line.`);
  });
  parts.open.addEventListener("click", () => parts.file.click());
  onFiles(parts.file, document.documentElement, (files) => void take(files));
  keeping(parts.keep, data);
  forgetting(parts, data);

  async function take(files: readonly File[]): Promise<void> {
    const { movements, problems } = await readFiles(files);
    const added = data.add(movements);
    const without = added.filter((movement) => approachOf(movement) === null).length;
    const known = movements.length - added.length;
    const more = [
      known > 0 ? ` ${known} were here already.` : "",
      without > 0 ? ` ${without} never enter their target and are not scored.` : "",
      problems.length > 0 ? " What could not be read is listed below the buttons." : "",
    ];
    parts.problems.replaceChildren(...problems.map(item));
    const read = movements.length > 0 ? `Read ${count(added.length, "movement")}.` : "No movement could be read.";
    data.write(`${read}${more.join("")}`);
  }
}

function item(words: string): HTMLElement {
  const element = document.createElement("li");
  element.textContent = words;
  return element;
}

function keeping(field: HTMLInputElement, data: Data): void {
  field.checked = isKeeping();
  field.addEventListener("change", async () => {
    try {
      if (field.checked) await keep(data.own());
      else await keepNothing();
      data.write(field.checked ? "Your movements are kept in this browser, for the next visit." : "Nothing is kept any more.");
    } catch {
      field.checked = false;
      data.write("This browser does not let the page keep anything.");
    }
  });
}

/** A second press within a few seconds is what forgets. */
function forgetting({ forget, keep: field, problems }: DataParts, data: Data): void {
  const words = forget.textContent;
  let timer = 0;
  const calm = () => {
    clearTimeout(timer);
    timer = 0;
    forget.textContent = words;
  };
  forget.addEventListener("click", async () => {
    const { length } = data.own();
    if (length > 0 && !timer) {
      forget.textContent = `Press again to forget ${count(length, "movement")}`;
      timer = window.setTimeout(calm, SURE);
      return;
    }
    calm();
    data.clear();
    problems.replaceChildren();
    field.checked = false;
    try {
      await keepNothing();
      data.write("Forgotten: nothing of yours is left here.");
    } catch {
      data.write("Forgotten on this page; this browser does not let it delete what was kept.");
    }
  });
}
