/** Lines out and in: a file to download, files by a button or dropped on the page. */
import { type Broken, readLines, writeLine, type Movement } from "./movement.ts";
import { count } from "./words.ts";

/** Messages that are listed; of more there is the number. */
const LISTED = 20;

/** Offers movements as a file. */
export function download(movements: readonly Movement[], name: string): void {
  const address = URL.createObjectURL(
    new Blob([movements.map((each) => `${writeLine(each)}\n`).join("")], { type: "application/jsonl" }),
  );
  const link = document.createElement("a");
  link.href = address;
  link.download = name;
  link.click();
  // the browser has taken it over by then
  setTimeout(() => URL.revokeObjectURL(address), 10_000);
}

/** What came of files that were given. */
export interface Imported {
  readonly movements: readonly Movement[];
  /** One message for each line that could not be read, and each file. */
  readonly problems: readonly string[];
}

export async function readFiles(files: readonly File[]): Promise<Imported> {
  const movements: Movement[] = [];
  const problems: string[] = [];
  for (const file of files) {
    const { movements: read, broken } = readLines(await file.text());
    movements.push(...read);
    problems.push(...listed(file.name, broken));
    if (read.length === 0 && broken.length === 0) problems.push(`${file.name} is empty.`);
  }
  return { movements, problems };
}

function listed(name: string, broken: readonly Broken[]): string[] {
  const messages = broken.slice(0, LISTED).map(({ line, message }) => `${name}, line ${line}: ${message}`);
  const more = broken.length - messages.length;
  return more > 0 ? [...messages, `${name}: ${count(more, "more line")} of that kind.`] : messages;
}

/** Files from a field of the page, or dropped anywhere on it. */
export function onFiles(field: HTMLInputElement, page: HTMLElement, given: (files: readonly File[]) => void): void {
  field.addEventListener("change", () => {
    given([...(field.files ?? [])]);
    field.value = "";
  });
  let inside = 0;
  const mark = (change: number) => {
    inside = Math.max(0, inside + change);
    page.toggleAttribute("data-dropping", inside > 0);
  };
  const hasFiles = (event: DragEvent) => event.dataTransfer?.types.includes("Files") ?? false;
  page.addEventListener("dragenter", (event) => hasFiles(event) && mark(1));
  page.addEventListener("dragleave", (event) => hasFiles(event) && mark(-1));
  page.addEventListener("dragover", (event) => hasFiles(event) && event.preventDefault());
  page.addEventListener("drop", (event) => {
    if (!hasFiles(event)) return;
    event.preventDefault();
    mark(-inside);
    given([...(event.dataTransfer?.files ?? [])]);
  });
}
