/** A slider's value in its unit, next to the slider and for screen readers. */
export function showValue(form: HTMLFormElement, name: string, text: string): void {
  const slider = form.elements.namedItem(name) as HTMLInputElement;
  const output = form.elements.namedItem(`${name}Shown`) as HTMLOutputElement;
  output.value = text;
  slider.setAttribute("aria-valuetext", text);
}
