import { Directive, ElementRef, EventEmitter, inject, type OnDestroy, Output } from "@angular/core";
import type { Intent, Release } from "whither/dom";
import { forget, intend } from "../intents.js";

/** `<a (intent)="..." (release)="...">` */
@Directive({ selector: "[intent]" })
export class IntentDirective implements OnDestroy {
  @Output() readonly intent = new EventEmitter<Intent>();
  @Output() readonly release = new EventEmitter<Release>();
  readonly #element = inject<ElementRef<Element>>(ElementRef).nativeElement;

  constructor() {
    intend(this.#element, {
      onIntent: (intent: Intent) => this.intent.emit(intent),
      onRelease: (release: Release) => this.release.emit(release),
    });
  }

  ngOnDestroy(): void {
    forget(this.#element);
  }
}
