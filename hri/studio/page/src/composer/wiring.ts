// Which ports there are, and which may be linked: the rules and words of `hri network check`.

import { isSlot, ownerOf, type Behavior, type Link, type Network } from "./network";

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
  /** Datatypes of outputs as `id.output`, where parameters decide them: the robot reads these. */
  datatypes: Record<string, string>;
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
  return types.get(type) ?? types.get(palette.aliases[type] ?? "");
}

export interface Ports {
  inputs: Port[];
  outputs: Port[];
}

/** Of a behavior, or of a slot as `board.name`; those that links name, where the type is unknown. */
export function portsOf(n: Network, palette: Palette, id: string): Ports {
  if (isSlot(id)) return slotPorts(n, palette, id);
  const behavior = behaviorsOf(n).get(id);
  const kind = behavior && behaviorKind(palette, behavior.type);
  if (kind) return { inputs: kind.inputs, outputs: kind.outputs.map((one) => ({ ...one, datatype: palette.datatypes[`${id}.${one.name}`] ?? one.datatype })) };
  const named = (ends: string[]) => [...new Set(ends.filter((one) => one.startsWith(`${id}.`)))].map((one) => unknown(one.slice(id.length + 1)));
  return { inputs: named(n.links.map((one) => one.to)), outputs: named(n.links.map((one) => one.from)) };
}

const known = new WeakMap<Network, Map<string, Behavior>>();

function behaviorsOf(n: Network): Map<string, Behavior> {
  let found = known.get(n);
  if (found === undefined) {
    found = new Map(n.behaviors.map((one) => [one.id, one]));
    known.set(n, found);
  }
  return found;
}

/** A slot has the datatype of what reads it, where the program itself knows none. */
function slotPorts(n: Network, palette: Palette, end: string): Ports {
  const slot = palette.slots.find((one) => `board.${one.name}` === end);
  const use = slotUses(n, palette, end).find((one) => one.port.datatype !== ANY);
  const port = { ...unknown(end.slice(6)), datatype: slot?.datatype ?? use?.port.datatype ?? ANY, semantic: slot?.semantic ?? GENERIC, description: slot?.about ?? "" };
  return { inputs: [port], outputs: [port] };
}

interface SlotUse {
  end: string;
  port: Port;
  /** Whether it takes what the slot has. */
  reads: boolean;
}

/** The ports of behaviors that links join to a slot, in the order of the file. */
function slotUses(n: Network, palette: Palette, slot: string): SlotUse[] {
  return n.links.flatMap(({ from, to }) => {
    if (from === slot && !isSlot(to)) return use(n, palette, to, "inputs");
    return to === slot && !isSlot(from) ? use(n, palette, from, "outputs") : [];
  });
}

function use(n: Network, palette: Palette, end: string, side: keyof Ports): SlotUse[] {
  const port = portNamed(n, palette, end, side);
  return typeof port === "string" ? [] : [{ end, port, reads: side === "inputs" }];
}

function unknown(name: string): Port {
  return { name, datatype: ANY, semantic: GENERIC, description: "", is_optional: true };
}

export type Verdict = { ok: true; warning: string } | { ok: false; reason: string };

const SAME = "link ports of the same datatype";

/** Whether an output may be linked to an input, both as links write them. */
export function canLink(n: Network, palette: Palette, from: string, to: string): Verdict {
  const sends = portNamed(n, palette, from, "outputs");
  const takes = portNamed(n, palette, to, "inputs");
  for (const port of [sends, takes]) if (typeof port === "string") return refused(port);
  return fits(n, palette, { end: from, port: sends as Port, reads: false }, { end: to, port: takes as Port, reads: true });
}

function fits(n: Network, palette: Palette, sends: SlotUse, takes: SlotUse): Verdict {
  const [from, to] = [sends.end, takes.end];
  if (isSlot(from) && isSlot(to)) return refused("both are slots of the board - link a behavior to one");
  const [sent, taken] = [sends.port, takes.port];
  if (!isSlot(from) && !isSlot(to) && areApart(sent.datatype, taken.datatype, ANY)) return refused(`${from} is ${sent.datatype}, but ${to} takes ${taken.datatype} - ${SAME}`);
  if (linked(n).has(`${from} ${to}`)) return refused(`the link ${from} -> ${to} is there already`);
  const circle = circleWith(n, from, to);
  if (circle) return refused(`these links would run in a circle: ${circle.join(", ")}`);
  if (isSlot(from)) return fitsSlot(n, palette, from, takes);
  if (isSlot(to)) return fitsSlot(n, palette, to, sends);
  return { ok: true, warning: areApart(sent.semantic, taken.semantic, GENERIC) ? `${from} means ${sent.semantic}, ${to} wants ${taken.semantic}` : "" };
}

/** All that use a slot must agree: with the program, else with the first of them. */
function fitsSlot(n: Network, palette: Palette, slot: string, { end, port, reads }: SlotUse): Verdict {
  const uses = slotUses(n, palette, slot);
  const reader = uses.find((one) => one.reads && one.port.datatype !== ANY)?.port.datatype ?? ANY;
  if (reads && areApart(reader, port.datatype, ANY)) return refused(`${slot} is ${reader}, but ${end} takes ${port.datatype} - ${SAME}`);
  const declared = palette.slots.find((one) => `board.${one.name}` === slot);
  const first = uses.find((one) => one.port.datatype !== ANY);
  const datatype = declared?.datatype ?? first?.port.datatype ?? ANY;
  const where = declared ? `here it is ${declared.about}` : first?.end;
  if (areApart(datatype, port.datatype, ANY)) return refused(`${slot} is ${datatype} (${where}), but ${end} is ${port.datatype} - ${SAME}`);
  const other = uses.find((one) => one.port.semantic !== GENERIC);
  const isMixed = other && areApart(other.port.semantic, port.semantic, GENERIC);
  return { ok: true, warning: isMixed ? `${slot}: ${end} means ${port.semantic}, ${other.end} means ${other.port.semantic}` : "" };
}

function areApart(one: string, other: string, whatever: string): boolean {
  return one !== other && one !== whatever && other !== whatever;
}

function refused(reason: string): Verdict {
  return { ok: false, reason };
}

const SLOT = /^[\p{L}\p{N}_]+([.-][\p{L}\p{N}_]+)*$/u;

function portNamed(n: Network, palette: Palette, text: string, side: keyof Ports): Port | string {
  if (isSlot(text)) return SLOT.test(text.slice(6)) ? unknown(text.slice(6)) : `"${text}" is not a slot of the board - write board.name, such as board.speech`;
  const id = ownerOf(text);
  const type = behaviorsOf(n).get(id)?.type;
  if (type === undefined) return `no behavior "${id}" for the link "${text}"`;
  const found = portsOf(n, palette, id)[side].find((one) => `${id}.${one.name}` === text);
  if (found) return found;
  return behaviorKind(palette, type) ? `${type} "${id}" has no ${side.slice(0, -1)} "${text.slice(id.length + 1)}"` : unknown(text.slice(id.length + 1));
}

const pairs = new WeakMap<Network, Set<string>>();

/** The links that there are, each as its two ends. */
function linked(n: Network): Set<string> {
  let found = pairs.get(n);
  if (found === undefined) pairs.set(n, (found = new Set(n.links.map((one) => `${one.from} ${one.to}`))));
  return found;
}

/** The links of a circle that one more would close; a slot of the board closes none. */
function circleWith(n: Network, from: string, to: string): string[] | null {
  if (isSlot(from) || isSlot(to)) return null;
  const [source, target] = [ownerOf(from), ownerOf(to)];
  const way = [`${from} -> ${to}`];
  const ways = waysTo(n, source);
  for (let id = target; id !== source; ) {
    const link = ways.get(id);
    if (link === undefined) return null;
    way.push(`${link.from} -> ${link.to}`);
    id = ownerOf(link.to);
  }
  return way;
}

const ways = new WeakMap<Network, Map<string, Map<string, Link>>>();

/** By behavior, the link by which what it sends comes nearer to another behavior. */
function waysTo(n: Network, goal: string): Map<string, Link> {
  let all = ways.get(n);
  if (all === undefined) ways.set(n, (all = new Map()));
  let found = all.get(goal);
  if (found === undefined) all.set(goal, (found = walkBack(linksTo(n), goal)));
  return found;
}

function walkBack(reaching: ReadonlyMap<string, Link[]>, goal: string): Map<string, Link> {
  const found = new Map<string, Link>();
  const waiting = [goal];
  for (let id = waiting.pop(); id !== undefined; id = waiting.pop())
    for (const link of reaching.get(id) ?? []) {
      const before = ownerOf(link.from);
      if (before === goal || found.has(before)) continue;
      found.set(before, link);
      waiting.push(before);
    }
  return found;
}

const reaching = new WeakMap<Network, Map<string, Link[]>>();

/** The links between behaviors, by the one that they lead to. */
function linksTo(n: Network): Map<string, Link[]> {
  let found = reaching.get(n);
  if (found === undefined) {
    reaching.set(n, (found = new Map()));
    for (const link of n.links) {
      if (isSlot(link.from) || isSlot(link.to)) continue;
      const known = found.get(ownerOf(link.to));
      if (known) known.push(link);
      else found.set(ownerOf(link.to), [link]);
    }
  }
  return found;
}
