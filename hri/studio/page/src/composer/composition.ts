// What the canvas shows: the network that is edited, alone or among all networks of its app.

import { behaviorKind, portsOf, type Palette, type Port } from "./wiring";
import type { Problem } from "./server";
import type { Box, Link, Network } from "./network";

export const TITLE = 46;
export const ROW = 20;
export const FOOT = 20;
const LETTER = 6.6;
const NARROWEST = 120;
/** A side with more ports shows the linked ones alone, and those of a selected behavior all. */
export const MOST_PORTS = 8;

export interface Part {
  id: string;
  /** Of its network; empty for the one that is edited. */
  network: string;
  kind: "behavior" | "slot";
  title: string;
  type: string;
  category: string;
  isSensor: boolean;
  isKnown: boolean;
  inputs: Port[];
  outputs: Port[];
  problems: Problem[];
  at: Box | undefined;
  width: number;
  height: number;
}

export interface Wire {
  id: string;
  network: string;
  link: Link;
  source: string;
  target: string;
  output: string;
  input: string;
  datatype: string;
  problem: string;
}

export interface Composition {
  parts: Map<string, Part>;
  wires: Wire[];
}

/** `id` and `port` of `id.port`; a slot of the board is a part of its own. */
export function ends(text: string): { id: string; port: string } {
  if (text.startsWith("board.")) return { id: text, port: text.slice(6) };
  const dot = text.indexOf(".");
  return dot < 0 ? { id: text, port: "" } : { id: text.slice(0, dot), port: text.slice(dot + 1) };
}

/** The text of an end, as a link has it. */
export function endText(id: string, port: string): string {
  return id.startsWith("board.") ? id : `${id}.${port}`;
}

/** The parts of one network; `network` goes before their keys. */
export function compose(network: Network, palette: Palette, problems: readonly Problem[], name = ""): Composition {
  const key = (id: string) => (name && !id.startsWith("board.") ? `${name}/${id}` : id);
  const linked = linkedPorts(network);
  const byBehavior = new Map<string, Problem[]>();
  for (const problem of problems)
    if (problem.behavior) byBehavior.set(problem.behavior, [...(byBehavior.get(problem.behavior) ?? []), problem]);
  const parts = new Map<string, Part>();
  for (const behavior of network.behaviors) {
    const kind = behaviorKind(palette, behavior.type);
    const ports = portsOf(network, palette, behavior.id);
    const part = {
      id: behavior.id,
      network: name,
      kind: "behavior" as const,
      title: behavior.id,
      type: behavior.type,
      category: kind?.category ?? "",
      isSensor: kind?.is_sensor ?? false,
      isKnown: kind !== undefined,
      inputs: shown(ports.inputs, linked.get(`>${behavior.id}`)),
      outputs: shown(ports.outputs, linked.get(`<${behavior.id}`)),
      problems: byBehavior.get(behavior.id) ?? [],
      at: network.boxes.get(behavior.id),
    };
    parts.set(key(behavior.id), { ...part, ...size(part) });
  }
  const wires: Wire[] = [];
  const known = new Map<string, number>();
  for (const link of network.links) {
    const source = ends(link.from);
    const target = ends(link.to);
    for (const end of [source, target])
      if (end.id.startsWith("board.") && !parts.has(end.id)) parts.set(end.id, slot(network, palette, end.id));
    if (!parts.has(key(source.id)) || !parts.has(key(target.id))) continue;
    const output = parts.get(key(source.id))!.outputs.find((one) => one.name === source.port);
    const problem = problems.find((one) => one.link?.from === link.from && one.link.to === link.to);
    const ending = `${name}#${link.from} -> ${link.to}`;
    known.set(ending, (known.get(ending) ?? 0) + 1);
    wires.push({
      id: known.get(ending) === 1 ? ending : `${ending} ${known.get(ending)}`,
      network: name,
      link,
      source: key(source.id),
      target: key(target.id),
      output: source.port,
      input: target.port,
      datatype: output?.datatype ?? "",
      problem: problem ? `${problem.what} - ${problem.remedy}` : "",
    });
  }
  return { parts, wires };
}

/** The next composition with the very parts and wires of the last one where they are the same: what
 * is not touched is not drawn again. */
export function settled(last: Composition, next: Composition): Composition {
  const parts = new Map([...next.parts].map(([key, part]) => {
    const had = last.parts.get(key);
    return [key, had && isSamePart(had, part) ? had : part];
  }));
  const wires = new Map(last.wires.map((one) => [one.id, one]));
  return {
    parts,
    wires: next.wires.map((wire) => {
      const had = wires.get(wire.id);
      return had && had.problem === wire.problem && had.datatype === wire.datatype ? had : wire;
    }),
  };
}

function isSamePart(a: Part, b: Part): boolean {
  const isSameList = <T>(one: readonly T[], other: readonly T[]) => one.length === other.length && one.every((item, place) => item === other[place]);
  return (
    a.type === b.type && a.isKnown === b.isKnown && a.width === b.width && a.height === b.height && a.at?.x === b.at?.x && a.at?.y === b.at?.y &&
    isSameList(a.inputs, b.inputs) && isSameList(a.outputs, b.outputs) && isSameList(a.problems, b.problems)
  );
}

/** The network that is edited among the others of its app, which share the slots of the board. */
export function together(own: Composition, others: Iterable<Composition>): Composition {
  const parts = new Map(own.parts);
  const wires = [...own.wires];
  for (const other of others) {
    for (const [key, part] of other.parts) {
      const known = parts.get(key);
      if (known === undefined) parts.set(key, part);
    }
    wires.push(...other.wires);
  }
  return { parts, wires };
}

function slot(network: Network, palette: Palette, id: string): Part {
  const ports = portsOf(network, palette, id);
  const about = palette.slots.find((one) => `board.${one.name}` === id)?.about ?? "";
  const part = {
    id,
    network: "",
    kind: "slot" as const,
    title: id.slice(6),
    type: "slot of the board",
    category: about,
    isSensor: false,
    isKnown: true,
    inputs: ports.inputs,
    outputs: ports.outputs,
    problems: [],
    at: network.boxes.get(id),
  };
  return { ...part, ...size(part) };
}

function linkedPorts(network: Network): Map<string, Set<string>> {
  const found = new Map<string, Set<string>>();
  for (const link of network.links)
    for (const [mark, text] of [["<", link.from], [">", link.to]] as const) {
      const { id, port } = ends(text);
      const ports = found.get(mark + id) ?? new Set();
      found.set(mark + id, ports.add(port));
    }
  return found;
}

function shown(ports: Port[], linked: Set<string> | undefined): Port[] {
  const known = new Set(ports.map((one) => one.name));
  const lost = [...(linked ?? [])].filter((name) => !known.has(name)).map(lostPort);
  const all = [...ports, ...lost];
  return all.length <= MOST_PORTS ? all : all.filter((one) => linked?.has(one.name) || !one.is_optional).slice(0, Math.max(MOST_PORTS, linked?.size ?? 0));
}

/** A port that a link names, but that the behavior does not have. */
function lostPort(name: string): Port {
  return { name, datatype: "", semantic: "", description: "there is no such port", is_optional: false };
}

function size(part: Pick<Part, "title" | "type" | "inputs" | "outputs">): { width: number; height: number } {
  const longest = (ports: Port[]) => Math.max(0, ...ports.map((one) => one.name.length));
  const letters = Math.max(longest(part.inputs) + longest(part.outputs) + 4, part.title.length + 4, part.type.length + 2);
  const rows = Math.max(part.inputs.length, part.outputs.length);
  return { width: Math.max(NARROWEST, Math.ceil(letters * LETTER) + 24), height: TITLE + rows * ROW + FOOT };
}

/** Where the parts stand: as the file says, else as `arranged` has it. */
export function placed(composition: Composition, arranged: ReadonlyMap<string, Box>): Map<string, Box> {
  const found = new Map<string, Box>();
  for (const [key, part] of composition.parts) found.set(key, part.at ?? arranged.get(key) ?? { x: 0, y: 0 });
  return found;
}
