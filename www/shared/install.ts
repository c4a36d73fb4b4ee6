/** The package, packed, lies beside these pages: so one line installs it from wherever they are served. */
import { part } from "./page.ts";

/** The line that installs it. */
export function installLine(): string {
  return `npm install ${new URL("whither.tgz", part<HTMLAnchorElement>("home").href).href}`;
}
