// The room from above, x ahead to the right, y to the left upward, in meters. What is in a simulated
// room is dragged to another place.

import { bounds, movables, type Base, type Movable, type Path, type SeenPerson, type World } from "./state";

const ROBOT = 0.17;
const PERSON = 0.22;
const THING = 0.2;
const GRIP = 0.35;
const STOP = 0.07;

type Drag = Movable & { to: [number, number] };

export class Map {
  private box: [number, number, number, number] = [0, 0, 1, 1];
  private world: World | null | undefined;
  private drag: Drag | null = null;

  constructor(
    private readonly svg: SVGSVGElement,
    put: (what: Movable | null, x: number, y: number) => void,
    private readonly redraw: () => void,
  ) {
    svg.addEventListener("pointerdown", (event) => {
      const here = this.place(event);
      const near = movables(this.world)
        .map((one) => ({ one, away: Math.hypot(one.at[0]! - here[0], one.at[1]! - here[1]) }))
        .filter(({ away }) => away < GRIP)
        .sort((a, b) => a.away - b.away)[0];
      if (near === undefined) return;
      this.drag = { ...near.one, to: here };
      svg.setPointerCapture(event.pointerId);
    });
    svg.addEventListener("pointermove", (event) => {
      if (this.drag === null) return;
      this.drag.to = this.place(event);
      this.redraw();
    });
    svg.addEventListener("pointerup", (event) => {
      const [x, y] = this.place(event);
      if (this.drag !== null || this.world) put(this.drag, x, y);
      this.drag = null;
    });
    svg.addEventListener("pointercancel", () => (this.drag = null));
  }

  /** Where what is dragged is held; another one at each move. */
  get carried(): readonly [number, number] | undefined {
    return this.drag?.to;
  }

  private place(event: PointerEvent): [number, number] {
    const edge = this.svg.getBoundingClientRect();
    const [left, low, width, height] = this.box;
    const scale = Math.min(edge.width / width, edge.height / height);
    const x = left + width / 2 + (event.clientX - edge.left - edge.width / 2) / scale;
    const y = low + height / 2 - (event.clientY - edge.top - edge.height / 2) / scale;
    return [x, y];
  }

  draw(world: World | null | undefined, base: Base | undefined, path: Path | undefined, persons: SeenPerson[]): void {
    this.world = world;
    // What is dragged must not change the scale under the pointer.
    if (this.drag === null) this.box = bounds(world, base);
    const [left, low, width, height] = this.box;
    this.svg.setAttribute("viewBox", `${left} ${-low - height} ${width} ${height}`);
    this.svg.replaceChildren(...room(world), ...way(path), ...this.moved(world), ...robot(base, world ? [] : persons));
  }

  private moved(world: World | null | undefined): SVGElement[] {
    const parts: SVGElement[] = [];
    const at = (kind: string, name: string, place: number[]) =>
      this.drag?.kind === kind && this.drag.name === name ? this.drag.to : place;
    for (const one of world?.obstacles ?? []) {
      const [x, y] = at("obstacle", one.name, one.at);
      parts.push(circle(x!, y!, one.radius, "obstacle movable"), words(one.name, x!, y! - one.radius - 0.2));
    }
    for (const one of world?.things ?? []) {
      const [x, y] = at("thing", one.name, one.at);
      parts.push(shape("rect", { x: x! - THING / 2, y: -y! - THING / 2, width: THING, height: THING }, "thing movable"));
      parts.push(words(one.name, x!, y! - 0.3));
    }
    for (const one of world?.people ?? []) {
      const [x, y] = at("person", one.name, one.at);
      parts.push(circle(x!, y!, PERSON, one.is_present ? "person movable" : "person movable away"));
      if (one.name) parts.push(words(one.name, x!, y! - PERSON - 0.2));
    }
    return parts;
  }
}

function room(world: World | null | undefined): SVGElement[] {
  const walls = (world?.walls ?? []).map(([x1, y1, x2, y2]) => shape("line", { x1: x1!, y1: -y1!, x2: x2!, y2: -y2! }, "wall"));
  return [...walls, ...(world?.circles ?? []).map(([x, y, radius]) => circle(x!, y!, radius!, "wall"))];
}

function way(path: Path | undefined): SVGElement[] {
  const parts = [line(path?.been ?? [], "been"), line(path?.planned ?? [], "planned")];
  for (const stop of path?.stops ?? []) {
    const mark = circle(stop.x, stop.y, STOP, "halt");
    const title = shape("title", {}, "");
    title.textContent = stop.words || stop.reason;
    mark.append(title);
    parts.push(mark);
  }
  return parts;
}

function robot(base: Base | undefined, persons: SeenPerson[]): SVGElement[] {
  if (!base?.pose) return [];
  const parts: SVGElement[] = [];
  const [x, y, heading] = base.pose as [number, number, number];
  for (const range of base.ranges) {
    const toward = heading + range.at[2]!;
    const reach = range.distance ?? 0.8;
    const end = { x2: x + reach * Math.cos(toward), y2: -y - reach * Math.sin(toward) };
    parts.push(shape("line", { x1: x, y1: -y, ...end }, range.distance === null ? "beam free" : "beam"));
  }
  for (const one of persons) {
    if (one.distance === null || one.bearing === null) continue;
    const toward = heading + one.bearing;
    parts.push(circle(x + one.distance * Math.cos(toward), y + one.distance * Math.sin(toward), PERSON, "person"));
  }
  const nose = { x2: x + ROBOT * Math.cos(heading), y2: -y - ROBOT * Math.sin(heading) };
  return [...parts, circle(x, y, ROBOT, "robot"), shape("line", { x1: x, y1: -y, ...nose }, "heading")];
}

function line(points: number[][], kind: string): SVGElement {
  const made = shape("polyline", {}, kind);
  made.setAttribute("points", points.map(([x, y]) => `${x},${-y!}`).join(" "));
  return made;
}

function circle(x: number, y: number, r: number, kind: string): SVGElement {
  return shape("circle", { cx: x, cy: -y, r }, kind);
}

function shape(name: string, places: Record<string, number>, kind: string): SVGElement {
  const made = document.createElementNS("http://www.w3.org/2000/svg", name);
  for (const [key, value] of Object.entries(places)) made.setAttribute(key, value.toFixed(3));
  if (kind) made.setAttribute("class", kind);
  return made;
}

function words(text: string, x: number, y: number): SVGElement {
  const made = shape("text", { x, y: -y }, "name");
  made.textContent = text;
  return made;
}
