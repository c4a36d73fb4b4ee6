import { forget, intend } from "../intents.js";

/** `customElements.define("port-link", PortLink)`; the style of one that is meant is `port-link:state(next)`. */
export class PortLink extends HTMLElement {
  #internals = this.attachInternals();

  constructor() {
    super();
    this.attachShadow({ mode: "open" }).innerHTML = `<a href="#"><slot></slot></a>`;
  }

  connectedCallback() {
    intend(this, {
      onIntent: () => this.#internals.states.add("next"),
      onRelease: () => this.#internals.states.delete("next"),
    });
  }

  disconnectedCallback() {
    forget(this);
  }
}
