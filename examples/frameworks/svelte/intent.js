import { forget, intend } from "../intents.js";

/** `{@attach intent({ onIntent, onRelease })}` */
export function intent(options) {
  return (element) => {
    intend(element, options);
    return () => forget(element);
  };
}
