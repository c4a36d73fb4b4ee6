import { onCleanup } from "solid-js";
import { forget, intend } from "../intents.js";

/** `<a ref={intent({ onIntent, onRelease })}>` */
export function intent(options) {
  return (element) => {
    intend(element, options);
    onCleanup(() => forget(element));
  };
}
