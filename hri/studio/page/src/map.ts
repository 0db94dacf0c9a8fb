// The room from above, x ahead to the right, y to the left upward, in meters.

import { bounds, type Base, type Person, type World } from "./state";

const ROBOT = 0.17;
const PERSON = 0.22;

export class Map {
  private box: [number, number, number, number] = [0, 0, 1, 1];

  constructor(private readonly svg: HTMLElement, go: (x: number, y: number) => void) {
    svg.addEventListener("click", (event) => {
      const edge = svg.getBoundingClientRect();
      const [left, low, width, height] = this.box;
      const scale = Math.min(edge.width / width, edge.height / height);
      const x = left + width / 2 + (event.clientX - edge.left - edge.width / 2) / scale;
      const y = low + height / 2 - (event.clientY - edge.top - edge.height / 2) / scale;
      go(x, y);
    });
  }

  draw(world: World | null | undefined, base: Base | undefined, persons: Person[]): void {
    this.box = bounds(world, base);
    const [left, low, width, height] = this.box;
    this.svg.setAttribute("viewBox", `${left} ${-low - height} ${width} ${height}`);
    const parts: SVGElement[] = [];
    for (const [x1, y1, x2, y2] of world?.walls ?? []) parts.push(shape("line", { x1, y1: -y1, x2, y2: -y2 }, "wall"));
    for (const [x, y, radius] of world?.circles ?? []) parts.push(shape("circle", { cx: x, cy: -y, r: radius }, "wall"));
    for (const one of world?.things ?? []) {
      parts.push(shape("rect", { x: one.at[0] - 0.1, y: -one.at[1] - 0.1, width: 0.2, height: 0.2 }, "thing"));
      parts.push(words(one.name, one.at[0], one.at[1] - 0.3));
    }
    for (const one of world?.people ?? [])
      parts.push(shape("circle", { cx: one.at[0], cy: -one.at[1], r: PERSON }, one.is_present ? "person" : "person away"));
    const pose = base?.pose;
    if (pose) {
      const [x, y, heading] = pose;
      for (const range of base!.ranges) {
        const way = heading + range.at[2];
        const reach = range.distance ?? 0.8;
        parts.push(shape("line", { x1: x, y1: -y, x2: x + reach * Math.cos(way), y2: -y - reach * Math.sin(way) }, range.distance === null ? "beam free" : "beam"));
      }
      if (!world)
        for (const one of persons)
          if (one.distance !== null)
            parts.push(shape("circle", { cx: x + one.distance * Math.cos(heading + one.bearing), cy: -y - one.distance * Math.sin(heading + one.bearing), r: PERSON }, "person"));
      parts.push(shape("circle", { cx: x, cy: -y, r: ROBOT }, "robot"));
      parts.push(shape("line", { x1: x, y1: -y, x2: x + ROBOT * Math.cos(heading), y2: -y - ROBOT * Math.sin(heading) }, "heading"));
    }
    this.svg.replaceChildren(...parts);
  }
}

function shape(name: string, places: Record<string, number>, kind: string): SVGElement {
  const made = document.createElementNS("http://www.w3.org/2000/svg", name);
  for (const [key, value] of Object.entries(places)) made.setAttribute(key, value.toFixed(3));
  made.setAttribute("class", kind);
  return made;
}

function words(text: string, x: number, y: number): SVGElement {
  const made = shape("text", { x, y: -y }, "name");
  made.textContent = text;
  return made;
}
