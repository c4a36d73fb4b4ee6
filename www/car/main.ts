/** What is there at the first frame: the icons, and what needs no prediction. All else is loaded then, and plays. */
import { PLACES } from "../shared/places.ts";
import example from "./example.js?raw";
import { listPapers } from "./papers.ts";
import { get } from "./view/get.ts";
import { begin, part } from "../shared/page.ts";
import { Screen } from "./view/screen.ts";
import { theme } from "../shared/theme.ts";
import { Status } from "../shared/status.ts";

const status = new Status(part("status"), part("announcement"));
const screen = new Screen(part("screen"), part("grid"), PLACES);
let restyle = () => {};

part("listing").textContent = example.trim();
listPapers(part("paper-list"));
get();
theme(part<HTMLButtonElement>("theme"), () => restyle());

begin(status, async () => {
  const { play } = await import("./play.ts");
  restyle = await play(screen, status);
});
