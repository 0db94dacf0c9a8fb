// What is in the simulated room, moved by keyboard: choose it, write where, put it there.

import { element } from "./dom";
import { freeName, movables, putCommand, type Movable, type World } from "./state";

type Ask = (command: string, given?: Record<string, unknown>) => void;

const NEW: Movable["kind"][] = ["obstacle", "thing"];

export class RoomForm {
  private all: Movable[] = [];
  private drawn = "";
  private readonly what = element<HTMLSelectElement>("put-what");
  private readonly x = element<HTMLInputElement>("put-x");
  private readonly y = element<HTMLInputElement>("put-y");

  constructor(private readonly ask: Ask) {
    element("put").addEventListener("submit", (event) => {
      event.preventDefault();
      const one = this.chosen();
      this.ask(...putCommand(one, this.x.valueAsNumber, this.y.valueAsNumber));
    });
    element("take-away").addEventListener("click", () => this.ask("remove", { name: this.chosen().name }));
    this.what.addEventListener("change", () => this.show());
  }

  draw(world: World | null | undefined): void {
    element("put").hidden = !world;
    this.all = movables(world);
    const names = this.all.map((one) => [one.kind, one.name]);
    if (this.drawn === JSON.stringify(names)) return;
    this.drawn = JSON.stringify(names);
    const before = this.what.value;
    const known = this.all.map((one) => new Option(title(one), `${one.kind}:${one.name}`));
    this.what.replaceChildren(...known, ...NEW.map((kind) => new Option(`new ${kind}`, `${kind}:`)));
    if ([...this.what.options].some((one) => one.value === before)) this.what.value = before;
    this.show();
  }

  private chosen(): Movable {
    const [kind, name] = this.what.value.split(/:(.*)/s) as [Movable["kind"], string];
    const found = this.all.find((one) => one.kind === kind && one.name === name);
    return found ?? { kind, name: freeName(kind, this.all), at: [1, 0] };
  }

  /** Where the chosen one is. */
  private show(): void {
    const one = this.chosen();
    [this.x.value, this.y.value] = [one.at[0]!.toFixed(1), one.at[1]!.toFixed(1)];
    element<HTMLButtonElement>("take-away").disabled = one.kind === "person" || !this.all.includes(one);
  }
}

function title(one: Movable): string {
  return one.kind === "person" ? one.name || "visitor" : one.name;
}
