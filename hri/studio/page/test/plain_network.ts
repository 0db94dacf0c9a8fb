// A network without a text: what random commands are compared with.

import type { Box, Network } from "../src/composer/network";
import { addBehavior, addLink, copy, freeId, idFor, move, paste, remove, rename, setAttribute, setParameter, type Splice } from "../src/composer/edits";
import { canLink, portsOf, type Palette } from "../src/composer/wiring";

export interface PlainBehavior {
  id: string;
  type: string;
  parameters: Record<string, string>;
}

export interface PlainNetwork {
  name: string | undefined;
  interval: string | undefined;
  behaviors: PlainBehavior[];
  links: string[];
  boxes: Record<string, Box>;
}

export function plain(n: Network): PlainNetwork {
  return {
    name: n.name,
    interval: n.interval,
    behaviors: n.behaviors.map(({ id, type, parameters }) => ({ id, type, parameters: Object.fromEntries(parameters) })),
    links: n.links.map(({ from, to }) => `${from} -> ${to}`),
    boxes: Object.fromEntries(n.boxes),
  };
}

/** Numbers from 0 to 1 that are the same for a seed (mulberry32). */
export function random(seed: number): () => number {
  return () => {
    seed = (seed + 0x6d2b79f5) | 0;
    let t = Math.imul(seed ^ (seed >>> 15), 1 | seed);
    t = (t + Math.imul(t ^ (t >>> 7), 61 | t)) ^ t;
    return ((t ^ (t >>> 14)) >>> 0) / 4294967296;
  };
}

/** A command as the page gives it, and what it means for a network without a text. */
export interface Command {
  label: string;
  splices: Splice[];
  change(model: PlainNetwork): void;
}

const MOST = 30;
const VALUES = ["1/3", "-2", "0.5", "pi", "1e3"];
const NAMES = ["", "a & b", '"<quoted>"', "it's", "ä→", "two\nlines"];
const SLOTS = ["board.speech", "board.drive.goal", "board.my-slot.2"];

/** A command that a person may give now. Of types it takes those named, with their numbers. */
export function command(n: Network, palette: Palette, types: readonly string[], chance: () => number): Command {
  const pick = <T>(all: readonly T[]): T => all[Math.floor(chance() * all.length)]!;
  const some = <T>(all: readonly T[], share: number): T[] => all.filter(() => chance() < share);
  const place = (): Box => ({ x: Math.floor(chance() * 2000) - 500, y: Math.floor(chance() * 2000) - 500 });
  const behavior = n.behaviors.length > 0 ? pick(n.behaviors) : undefined;
  const link = n.links.length > 0 ? pick(n.links) : undefined;
  const what = chance();
  if (behavior === undefined || (what < 0.2 && n.behaviors.length < MOST)) return adding(n, pick(types), palette, chance() < 0.5 ? place() : undefined, pick(VALUES));
  if (what < 0.5) return linking(n, palette, pick, SLOTS) ?? moving(n, new Map([[behavior.id, place()]]));
  if (what < 0.62) return moving(n, new Map([...some(n.behaviors.map((one) => one.id), 0.2), ...(chance() < 0.2 ? [pick(SLOTS)] : [])].map((id) => [id, place()])));
  if (what < 0.7) return setting(n, behavior.id, palette, pick(VALUES), pick);
  if (what < 0.76) return renaming(n, behavior.id, freeId(n, pick(["x", "camera", "äß", behavior.id])));
  if (what < 0.82) return heading(n, pick(["name", "invocation_interval"] as const), chance() < 0.4 ? null : pick(VALUES), pick(NAMES));
  if (what < 0.88 && link) return unlinking(n, chance() < 0.1 ? n.links.map((_, at) => at) : [n.links.indexOf(link)]);
  if (what < 0.93 && n.behaviors.length < MOST) return pasting(n, some(n.behaviors.map((one) => one.id), 0.15), { x: 30, y: 30 });
  return removing(n, chance() < 0.05 ? [...n.behaviors.map((one) => one.id), ...SLOTS] : [behavior.id, ...some(SLOTS, 0.2)]);
}

/** The parameters that take any number. */
function numbersOf(palette: Palette, type: string): string[] {
  const { parameters = [] } = palette.behaviors.find((one) => one.type === type) ?? {};
  return parameters.filter((one) => one.type === "number" && one.minimum === null && one.maximum === null).map((one) => one.name);
}

function adding(n: Network, type: string, palette: Palette, at: Box | undefined, value: string): Command {
  const id = freeId(n, idFor(type));
  const own = numbersOf(palette, type).slice(0, 1);
  const parameters = own.map((name): [string, string] => [name, value]);
  return {
    label: `add ${id}`,
    splices: addBehavior(n, { id, type, parameters }, at),
    change(model) {
      model.behaviors.push({ id, type, parameters: Object.fromEntries(parameters) });
      if (at) model.boxes[id] = at;
    },
  };
}

function linking(n: Network, palette: Palette, pick: <T>(all: readonly T[]) => T, slots: readonly string[]): Command | null {
  const ends = (side: "inputs" | "outputs") => [...slots, ...n.behaviors.flatMap(({ id }) => portsOf(n, palette, id)[side].map((one) => `${id}.${one.name}`))];
  const [from, to] = [pick(ends("outputs")), pick(ends("inputs"))];
  if (!canLink(n, palette, from, to).ok) return null;
  return { label: `link ${from} -> ${to}`, splices: addLink(n, from, to), change: (model) => void model.links.push(`${from} -> ${to}`) };
}

function moving(n: Network, boxes: Map<string, Box>): Command {
  return { label: `move ${[...boxes.keys()]}`, splices: move(n, boxes), change: (model) => void Object.assign(model.boxes, Object.fromEntries(boxes)) };
}

function setting(n: Network, id: string, palette: Palette, value: string, pick: <T>(all: readonly T[]) => T): Command {
  const behavior = n.behaviors.find((one) => one.id === id)!;
  const names = numbersOf(palette, behavior.type);
  if (names.length === 0) return moving(n, new Map([[id, { x: 1, y: 2 }]]));
  const name = pick(names);
  const text = pick([value, value, null]);
  return {
    label: `set ${id}.${name} ${text}`,
    splices: setParameter(n, id, name, text),
    change(model) {
      const { parameters } = model.behaviors.find((one) => one.id === id)!;
      if (text === null) delete parameters[name];
      else parameters[name] = text;
    },
  };
}

function renaming(n: Network, id: string, newId: string): Command {
  const renamed = (end: string) => (end.startsWith(`${id}.`) ? newId + end.slice(id.length) : end);
  return {
    label: `rename ${id} ${newId}`,
    splices: rename(n, id, newId),
    change(model) {
      model.behaviors.find((one) => one.id === id)!.id = newId;
      model.links = model.links.map((one) => one.split(" -> ").map(renamed).join(" -> "));
      const box = model.boxes[id];
      delete model.boxes[id];
      if (box) model.boxes[newId] = box;
    },
  };
}

function heading(n: Network, name: "name" | "invocation_interval", interval: string | null, title: string): Command {
  // An interval is a positive number, a name anything.
  const value = interval === null ? null : name === "name" ? title : "1/30";
  return {
    label: `${name} ${value}`,
    splices: setAttribute(n, name, value),
    change: (model) => void (model[name === "name" ? "name" : "interval"] = value ?? undefined),
  };
}

function unlinking(n: Network, places: number[]): Command {
  return {
    label: `unlink ${places}`,
    splices: remove(n, [], places.map((at) => n.links[at]!)),
    change: (model) => void (model.links = model.links.filter((_, at) => !places.includes(at))),
  };
}

function removing(n: Network, ids: string[]): Command {
  const isGone = (end: string) => ids.includes(end) || ids.includes(end.split(".")[0]!);
  return {
    label: `remove ${ids}`,
    splices: remove(n, ids, []),
    change(model) {
      model.behaviors = model.behaviors.filter((one) => !ids.includes(one.id));
      model.links = model.links.filter((one) => !one.split(" -> ").some(isGone));
      for (const id of ids) delete model.boxes[id];
    },
  };
}

function pasting(n: Network, ids: string[], shift: Box): Command {
  const pasted = paste(n, copy(n, ids), shift);
  return {
    label: `paste ${ids}`,
    splices: pasted.splices,
    change(model) {
      const copied = model.behaviors.filter((one) => ids.includes(one.id));
      const names = new Map(copied.map(({ id }, number) => [id, pasted.ids[number]!]));
      model.behaviors.push(...copied.map((one) => ({ ...one, id: names.get(one.id)!, parameters: { ...one.parameters } })));
      const end = (text: string) => (text.startsWith("board.") ? text : names.get(text.split(".")[0]!) && names.get(text.split(".")[0]!) + text.slice(text.indexOf(".")));
      for (const link of [...model.links]) {
        const [from, to] = link.split(" -> ") as [string, string];
        if ((names.has(from.split(".")[0]!) || from.startsWith("board.")) && (names.has(to.split(".")[0]!) || to.startsWith("board.")) && !(from.startsWith("board.") && to.startsWith("board."))) model.links.push(`${end(from)} -> ${end(to)}`);
      }
      for (const [id, name] of names) if (model.boxes[id]) model.boxes[name] = { x: model.boxes[id].x + shift.x, y: model.boxes[id].y + shift.y };
    },
  };
}

/** A network of so many behaviors in layers, each linked to some of the layer before, and placed. */
export function large(count: number): string {
  const chance = random(count);
  const ids = Array.from({ length: count }, (_, number) => `part${number}`);
  const before = (number: number) => `part${Math.floor(chance() * Math.min(number, 30)) + Math.max(0, number - 30)}`;
  return [
    '<?xml version="1.0" encoding="UTF-8"?>',
    '<BehaviorNetwork name="large">',
    ...ids.map((id) => `  <Behavior id="${id}" type="Hri.Scale">\n    <Parameter name="factor" value="1/2"/>\n  </Behavior>`),
    ...ids.slice(1).flatMap((id, at) => [0, 1].map(() => `  <Link from="${before(at + 1)}.output" to="${id}.input"/>`)),
    "  <Layout>",
    ...ids.map((id, number) => `    <Box id="${id}" x="${(number % 20) * 200}" y="${Math.floor(number / 20) * 120}"/>`),
    "  </Layout>",
    "</BehaviorNetwork>",
    "",
  ].join("\n");
}

/** Milliseconds of a processor that it takes: the least of some turns, since others use the machine as well. */
export function milliseconds(work: () => unknown, turns = 15): number {
  const times = Array.from({ length: turns }, () => {
    const start = process.cpuUsage();
    work();
    const { user, system } = process.cpuUsage(start);
    return (user + system) / 1000;
  });
  return Math.min(...times);
}

/** The least time of each work, ms, of many turns in which one follows the other: a machine that slows down meanwhile slows all. */
export function inTurns(works: readonly (() => unknown)[], turns = 40): number[] {
  const least = works.map(() => Infinity);
  for (let turn = 0; turn < turns; turn++) {
    works.forEach((work, number) => {
      least[number] = Math.min(least[number] ?? Infinity, milliseconds(work, 1));
    });
  }
  return least;
}
