/** The canvas, by WebGL where there is any; and the name of the leading icon over it. */
import { LABELS, TARGETS } from "../cabin.ts";
import { leader } from "../forecast.ts";
import { colours } from "../../shared/colours.ts";
import { percent } from "../../shared/format.ts";
import { Camera } from "./camera.ts";
import { Cockpit, type Palette, type Picture } from "./cockpit.ts";
import type { Glyph } from "./glyphs.ts";
import { PlainView } from "./plain.ts";
import type { Colour, View } from "./view.ts";

const NAMES = ["ground", "screen", "line", "rest", "muted", "text", "light", "glow"] as const;
/** The leading icon has its name above it from this probability on. */
const NAMED = 0.15;

export class Stage {
  readonly #root: HTMLElement;
  readonly #name: HTMLElement;
  readonly #cockpit: Cockpit;
  readonly camera = new Camera();
  #view: View;

  /** `root` holds the canvas, a `canvas` of its own making, below what it has already. */
  static async on(root: HTMLElement, glyphs: readonly Glyph[]): Promise<Stage> {
    return new Stage(root, glyphs, await viewOn(root));
  }

  private constructor(root: HTMLElement, glyphs: readonly Glyph[], view: View) {
    this.#root = root;
    this.#name = nameOn(root);
    this.#cockpit = new Cockpit(glyphs, paletteOf(root), hairline());
    this.#view = view;
    root.dataset["view"] = view.kind;
    this.fit();
  }

  /** After a change of size, theme or resolution. */
  fit(): void {
    const { clientWidth, clientHeight } = this.#root;
    this.camera.resize(clientWidth, clientHeight);
    this.#view.resize(clientWidth, clientHeight, devicePixelRatio);
    this.#cockpit.restyle(paletteOf(this.#root), hairline());
  }

  draw(picture: Picture): void {
    this.#view.draw(this.#cockpit.shapes(picture), this.camera);
    this.#label(picture);
  }

  /** Where WebGL is lost it goes on without it. */
  replace(): void {
    this.#view.free();
    this.#root.querySelector("canvas")?.remove();
    this.#view = new PlainView(canvasOn(this.#root));
    this.#root.dataset["view"] = this.#view.kind;
    this.fit();
  }

  #label({ moment, touched }: Picture): void {
    const name = this.#name;
    const { icon, label, probability } = moment ? leader(moment) : { icon: 0, label: "", probability: 0 };
    const shown = touched ?? icon;
    name.hidden = touched === null && probability < NAMED;
    if (name.hidden) return;
    const { x = 0, y = 0 } = TARGETS[shown] ?? {};
    const place = this.camera.project([x, y - 19, 1]);
    name.textContent = touched === null ? `${label} ${percent(probability)}` : (LABELS[shown] ?? "");
    name.style.setProperty("--x", `${place.x}px`);
    name.style.setProperty("--y", `${place.y}px`);
  }

  /** Calls back where WebGL is lost, as by a driver that is updated. */
  onLost(lost: () => void): void {
    this.#root.querySelector("canvas")?.addEventListener("webglcontextlost", lost);
  }
}

async function viewOn(root: HTMLElement): Promise<View> {
  const canvas = canvasOn(root);
  const gl = canvas.getContext("webgl2");
  if (!gl || isEmulated(gl)) {
    gl?.getExtension("WEBGL_lose_context")?.loseContext();
    canvas.remove();
    return new PlainView(canvasOn(root));
  }
  try {
    const { WebglView } = await import("./webgl.ts");
    return new WebglView(canvas, gl);
  } catch {
    // a driver that does not take the shaders
    canvas.remove();
    return new PlainView(canvasOn(root));
  }
}

/** Where the processor does what a graphics card should, a plain canvas is drawn three times as fast. */
function isEmulated(gl: WebGL2RenderingContext): boolean {
  const names = gl.getExtension("WEBGL_debug_renderer_info");
  const renderer = gl.getParameter(names ? names.UNMASKED_RENDERER_WEBGL : gl.RENDERER);
  return /swiftshader|llvmpipe|software|basic render/i.test(String(renderer));
}

/** What is on it is in the list and in the status, in words. */
function canvasOn(root: HTMLElement): HTMLCanvasElement {
  const canvas = document.createElement("canvas");
  canvas.setAttribute("role", "img");
  canvas.setAttribute("aria-label", "A hand on its way to a car’s screen with 21 icons");
  canvas.setAttribute("aria-describedby", "status");
  root.prepend(canvas);
  return canvas;
}

function nameOn(root: HTMLElement): HTMLElement {
  const name = document.createElement("p");
  name.className = "name-of-icon figure";
  name.setAttribute("aria-hidden", "true");
  name.hidden = true;
  root.append(name);
  return name;
}

function hairline(): number {
  return Number.parseFloat(getComputedStyle(document.documentElement).fontSize) / 16;
}

function paletteOf(root: HTMLElement): Palette {
  const found = colours(root, NAMES);
  const context = document.createElement("canvas").getContext("2d", { willReadFrequently: true });
  const numbers = (colour: string): Colour => {
    if (!context) return [128, 128, 128, 1];
    context.clearRect(0, 0, 1, 1);
    context.fillStyle = colour;
    context.fillRect(0, 0, 1, 1);
    const [red = 0, green = 0, blue = 0] = context.getImageData(0, 0, 1, 1).data;
    return [red, green, blue, 1];
  };
  const entries = NAMES.map((name) => [name, numbers(found[name])] as const);
  const strength = Number(getComputedStyle(root).getPropertyValue("--glow-strength"));
  return { ...(Object.fromEntries(entries) as Record<(typeof NAMES)[number], Colour>), strength };
}
