/** A slider's value as it is meant, beside the slider and for those who hear it. */
export function showValue(form: HTMLFormElement, name: string, text: string): void {
  const slider = form.elements.namedItem(name) as HTMLInputElement;
  const output = form.elements.namedItem(`${name}Shown`) as HTMLOutputElement;
  output.value = text;
  slider.setAttribute("aria-valuetext", text);
}
