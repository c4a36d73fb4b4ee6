import { Component, signal } from "@angular/core";
import { IntentDirective } from "./intent.js";

@Component({
  selector: "app-ports",
  imports: [IntentDirective],
  template: `
    <nav>
      @for (port of ports(); track port) {
        <a href="#{{ port }}" (intent)="next.set(port)" (release)="next.set('none')">{{ port }}</a>
      }
    </nav>
    <button (click)="ports.set(['Bembridge', 'Cowes'])">Others</button>
    <output>{{ next() }}</output>
  `,
})
export class App {
  readonly ports = signal(["Cowes", "Ryde", "Yarmouth"]);
  readonly next = signal("none");
}
