/** The button that has the simulated hand of `whither/testing` make movements in the field. */
import type { Field } from "./field.ts";
import type { Movement, Sample } from "./movement.ts";
import { Player } from "./player.ts";
import { simulate } from "./simulated.ts";

/** Movements of one press of the button. */
const MANY = 20;
/** Those that are there at once. */
const AT_FIRST = 24;

export interface HandEvents {
  /** It is about to move. */
  begins(words: string): void;
  /** After these samples of its movement; none where it is over. */
  moved(samples: readonly Sample[]): void;
  made(movements: readonly Movement[]): void;
}

export class Hand {
  readonly #button: HTMLButtonElement;
  readonly #field: Field;
  readonly #events: HandEvents;
  readonly #player: Player;
  /** The arrangements that have an example. */
  readonly #examples = new Set<string>();
  #seed = 1;

  constructor(button: HTMLButtonElement, field: Field, events: HandEvents) {
    this.#button = button;
    this.#field = field;
    this.#events = events;
    this.#player = new Player({
      moved(samples) {
        field.showArrow(samples);
        events.moved(samples);
      },
      arrived(movement, [next]) {
        events.made([movement]);
        field.goOn(movement.target, next?.target ?? field.from);
      },
      ended: () => this.#label(),
    });
    this.#label();
    button.addEventListener("click", () => {
      if (this.#player.playing) this.stop();
      else this.#start();
    });
  }

  /** The first movements in this arrangement of the targets, at once; nothing where it has them. */
  showExample(): void {
    const { layout } = this.#field;
    if (this.#examples.has(layout)) return;
    this.#examples.add(layout);
    this.#events.made(simulate(this.#field, AT_FIRST, 1));
  }

  stop(): void {
    this.#player.stop();
  }

  #start(): void {
    const field = this.#field;
    this.#events.begins(`The simulated hand of whither/testing makes ${MANY} movements.`);
    this.#button.textContent = "Stop the simulated hand";
    const movements = simulate(field, MANY, (this.#seed += 1), field.from);
    field.goOn(field.from, movements[0]?.target ?? field.from);
    this.#player.play(movements, matchMedia("(prefers-reduced-motion: reduce)").matches);
  }

  #label(): void {
    this.#button.textContent = `Let the simulated hand do ${MANY}`;
  }
}
