import { forget, intend } from "../intents.js";

/** `v-intent="{ onIntent, onRelease }"` */
export const vIntent = {
  mounted: (element, { value }) => intend(element, value),
  updated: (element, { value }) => intend(element, value),
  beforeUnmount: forget,
};
