// A list of what happened, of which one row is current. It is one stop of the Tab key; up and down
// go through it.

import type { Row } from "./dom";
import { clock, lastBy } from "./recording";

export class Rows {
  private times: number[] = [];
  private current = -1;

  constructor(private readonly parent: HTMLElement, go: (time: number) => void) {
    parent.addEventListener("click", (event) => {
      const button = (event.target as Element).closest("button");
      if (button !== null) go(this.times[this.place(button)]!);
    });
    parent.addEventListener("keydown", (event) => {
      const step = { ArrowUp: -1, ArrowDown: 1 }[event.key];
      const next = step === undefined ? undefined : this.button(this.place(event.target as Element) + step);
      if (next === undefined) return;
      event.preventDefault();
      this.reach(next);
      next.focus();
    });
  }

  clear(): void {
    this.parent.replaceChildren();
    this.times = [];
    this.current = -1;
  }

  /** Show further rows behind those that are there. */
  add(rows: readonly (Row & { time: number })[]): void {
    this.times.push(...rows.map((row) => row.time));
    this.parent.append(...rows.map(item));
    if (this.current < 0) this.reach(this.button(0));
  }

  /** Mark the last row that has begun by a time, and bring it into view. */
  show(time: number): void {
    const place = lastBy(this.times, time, (one) => one);
    if (place === this.current) return;
    this.button(this.current)?.removeAttribute("aria-current");
    this.current = place;
    const button = this.button(Math.max(0, place));
    if (button === undefined) return;
    if (place >= 0) button.setAttribute("aria-current", "true");
    if (!this.parent.contains(document.activeElement)) this.reach(button);
    this.parent.scrollTop = button.parentElement!.offsetTop - this.parent.clientHeight / 2;
  }

  private button(place: number): HTMLButtonElement | undefined {
    return this.parent.children[place]?.querySelector("button") ?? undefined;
  }

  private place(inside: Element): number {
    return Array.prototype.indexOf.call(this.parent.children, inside.closest("li"));
  }

  /** Let the Tab key come to this row, and to no other. */
  private reach(button: HTMLButtonElement | undefined): void {
    this.parent.querySelector('button[tabindex="0"]')?.setAttribute("tabindex", "-1");
    button?.setAttribute("tabindex", "0");
  }
}

function item(row: Row & { time: number }): HTMLElement {
  const line = document.createElement("li");
  const button = document.createElement("button");
  button.type = "button";
  button.tabIndex = -1;
  if (row.kind) line.className = row.kind;
  button.append(part("time", clock(row.time, 1)), part("span", row.text));
  if (row.detail) button.append(part("small", row.detail));
  line.append(button);
  return line;
}

function part(name: string, text: string): HTMLElement {
  const made = document.createElement(name);
  made.textContent = text;
  return made;
}
