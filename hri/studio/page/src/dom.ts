// Small things about elements.

export interface Row {
  text: string;
  detail: string;
  kind: string;
  time?: number;
}

/** The element of this id, which the page has. */
export function element<T extends Element = HTMLElement>(id: string): T {
  const found = document.getElementById(id);
  if (found === null) throw new Error(`the page has no ${id}`);
  return found as unknown as T;
}

export function replace(parent: Element, children: Element[]): void {
  parent.replaceChildren(...children);
}

const drawn = new WeakMap<Element, string>();

/** Show rows as items of a list; nothing is touched while they are the same, so that a screen reader
 * and a selection are left alone. */
export function list<T>(parent: Element, items: readonly T[], row: (item: T) => Row): void {
  const rows = items.map(row);
  const told = JSON.stringify(rows);
  if (drawn.get(parent) === told) return;
  drawn.set(parent, told);
  replace(parent, rows.map(item));
}

/** Parts of the page, each drawn only when one of the values that it shows is another than before. */
export class Parts {
  private readonly shown = new Map<string, readonly unknown[]>();

  draw(name: string, values: readonly unknown[], draw: () => void): void {
    const before = this.shown.get(name);
    if (before !== undefined && values.every((value, place) => value === before[place])) return;
    this.shown.set(name, values);
    draw();
  }
}

function item(row: Row): HTMLElement {
  const line = document.createElement("li");
  if (row.kind) line.className = row.kind;
  if (row.time !== undefined) line.append(part("time", row.time.toFixed(1)));
  line.append(part("span", row.text));
  if (row.detail) line.append(part("small", row.detail));
  return line;
}

function part(name: string, text: string): HTMLElement {
  const made = document.createElement(name);
  made.textContent = text;
  return made;
}
