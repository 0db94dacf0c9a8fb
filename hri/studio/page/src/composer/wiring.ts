// Which ports there are, and which may be linked: the rules and words of `hri network check`.

import type { Network } from "./network";

export interface Port {
  name: string;
  datatype: string;
  semantic: string;
  description: string;
  is_optional: boolean;
}

export interface Parameter {
  name: string;
  type: string;
  default: string;
  description: string;
  minimum: number | null;
  maximum: number | null;
  choices: string[];
  unit: string;
  /** What kind of device its value is the id of. */
  interface: string | null;
}

export interface BehaviorType {
  type: string;
  category: string;
  display_name: string;
  about: string;
  is_sensor: boolean;
  library: string;
  parameters: Parameter[];
  inputs: Port[];
  outputs: Port[];
}

export interface Palette {
  mark: string;
  behaviors: BehaviorType[];
  /** Today's names by older ones. */
  aliases: Record<string, string>;
  slots: { name: string; datatype: string; semantic: string; about: string }[];
  devices: { id: string; interface: string; about: string }[];
  broken: { type: string; what: string }[];
}

const ANY = "any";
const GENERIC = "Evolution.Generic";

const byType = new WeakMap<Palette, Map<string, BehaviorType>>();

export function behaviorKind(palette: Palette, type: string): BehaviorType | undefined {
  let types = byType.get(palette);
  if (types === undefined) {
    types = new Map(palette.behaviors.map((one) => [one.type, one]));
    byType.set(palette, types);
  }
  return types.get(type) ?? types.get(today(palette, type));
}

/** Of 2003's names, those that are not in the table begin with another word alone. */
function today(palette: Palette, type: string): string {
  const name = palette.aliases[type] ?? type.replace(/^Evolution\./, "Hri.");
  return palette.aliases[name] ?? name;
}

export interface Ports {
  inputs: Port[];
  outputs: Port[];
}

/** Of a behavior, or of a slot as `board.name`; those that links name, where the type is unknown. */
export function portsOf(n: Network, palette: Palette, id: string): Ports {
  if (id.startsWith("board.")) return slotPorts(palette, id.slice(6));
  const type = typesOf(n).get(id);
  const kind = type === undefined ? undefined : behaviorKind(palette, type);
  if (kind) return { inputs: kind.inputs, outputs: kind.outputs };
  const named = (ends: string[]) => [...new Set(ends.filter((one) => one.startsWith(`${id}.`)))].map((one) => unknown(one.slice(id.length + 1)));
  return { inputs: named(n.links.map((one) => one.to)), outputs: named(n.links.map((one) => one.from)) };
}

const types = new WeakMap<Network, Map<string, string>>();

function typesOf(n: Network): Map<string, string> {
  let found = types.get(n);
  if (found === undefined) {
    found = new Map(n.behaviors.map((one) => [one.id, one.type]));
    types.set(n, found);
  }
  return found;
}

function slotPorts(palette: Palette, name: string): Ports {
  const slot = palette.slots.find((one) => one.name === name);
  const port = { ...unknown(name), datatype: slot?.datatype ?? ANY, semantic: slot?.semantic ?? GENERIC, description: slot?.about ?? "" };
  return { inputs: [port], outputs: [port] };
}

function unknown(name: string): Port {
  return { name, datatype: ANY, semantic: GENERIC, description: "", is_optional: true };
}

export type Verdict = { ok: true; warning: string } | { ok: false; reason: string };

/** Whether an output may be linked to an input, both as links write them. */
export function canLink(n: Network, palette: Palette, from: string, to: string): Verdict {
  const sends = portNamed(n, palette, from, "outputs");
  const takes = portNamed(n, palette, to, "inputs");
  if (typeof sends === "string") return { ok: false, reason: sends };
  if (typeof takes === "string") return { ok: false, reason: takes };
  if (from.startsWith("board.") && to.startsWith("board.")) return { ok: false, reason: "both are slots of the board - link a behavior to one" };
  if (sends.datatype !== takes.datatype && sends.datatype !== ANY && takes.datatype !== ANY)
    return { ok: false, reason: `${from} is ${sends.datatype}, but ${to} takes ${takes.datatype} - link ports of the same datatype` };
  if (n.links.some((one) => one.from === from && one.to === to)) return { ok: false, reason: `the link ${from} -> ${to} is there already` };
  const circle = circleWith(n, ownerOf(from), ownerOf(to));
  if (circle) return { ok: false, reason: `the links would run in a circle: ${circle.join(" -> ")}` };
  const isMixed = sends.semantic !== takes.semantic && sends.semantic !== GENERIC && takes.semantic !== GENERIC;
  return { ok: true, warning: isMixed ? `${from} means ${sends.semantic}, ${to} wants ${takes.semantic}` : "" };
}

function portNamed(n: Network, palette: Palette, text: string, side: keyof Ports): Port | string {
  if (text.startsWith("board.")) return slotPorts(palette, text.slice(6))[side][0]!;
  const id = ownerOf(text);
  const type = typesOf(n).get(id);
  if (type === undefined) return `no behavior "${id}" for the link "${text}"`;
  const found = portsOf(n, palette, id)[side].find((one) => `${id}.${one.name}` === text);
  if (found) return found;
  return behaviorKind(palette, type) ? `${type} "${id}" has no ${side.slice(0, -1)} "${text.slice(id.length + 1)}"` : unknown(text.slice(id.length + 1));
}

function ownerOf(end: string): string {
  return end.startsWith("board.") ? end : end.split(".", 1)[0]!;
}

/** The behaviors of a circle that a link between two of them would close; a slot of the board closes none. */
function circleWith(n: Network, source: string, target: string): string[] | null {
  if (source.startsWith("board.") || target.startsWith("board.")) return null;
  const after = followers(n);
  const cameFrom = new Map<string, string>([[target, ""]]);
  const waiting = [target];
  for (let id = waiting.pop(); id !== undefined; id = waiting.pop()) {
    if (id === source) {
      const way: string[] = [];
      for (let one = source; one !== ""; one = cameFrom.get(one)!) way.unshift(one);
      return [source, ...way];
    }
    for (const next of after.get(id) ?? [])
      if (!cameFrom.has(next)) {
        cameFrom.set(next, id);
        waiting.push(next);
      }
  }
  return null;
}

const following = new WeakMap<Network, Map<string, string[]>>();

function followers(n: Network): Map<string, string[]> {
  let found = following.get(n);
  if (found === undefined) {
    found = new Map();
    for (const { from, to } of n.links) {
      if (from.startsWith("board.") || to.startsWith("board.")) continue;
      const known = found.get(ownerOf(from));
      if (known) known.push(ownerOf(to));
      else found.set(ownerOf(from), [ownerOf(to)]);
    }
    following.set(n, found);
  }
  return found;
}
