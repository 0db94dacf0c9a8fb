// The commands of the composer as splices of the text: what they do not mean stays as it is, byte
// by byte. What they write is written as `hri network format` would.

import { attribute, escape, type Element } from "./xml";
import { EMPTY, layoutOf, readNetwork, type Box, type Link, type Network } from "./network";

/** Offsets in the text before. */
export interface Splice {
  from: number;
  to: number;
  insert: string;
}

const INDENT = "  ";

/** Splices come in order and do not overlap. */
export function applySplices(text: string, splices: readonly Splice[]): string {
  let made = "";
  let at = 0;
  for (const { from, to, insert } of splices) {
    made += text.slice(at, from) + insert;
    at = to;
  }
  return made + text.slice(at);
}

/** What turns the text that the splices made back into the one before. */
export function inverse(text: string, splices: readonly Splice[]): Splice[] {
  let shift = 0;
  return splices.map(({ from, to, insert }) => {
    const back = { from: from + shift, to: from + shift + insert.length, insert: text.slice(from, to) };
    shift += insert.length - (to - from);
    return back;
  });
}

function joined(...all: Splice[][]): Splice[] {
  const splices = all.flat().sort((a, b) => a.from - b.from || a.to - b.to);
  const merged: Splice[] = [];
  for (const one of splices) {
    const last = merged.at(-1);
    // Two that are put in at one place are put in one after the other.
    if (last && last.to === one.from && last.from === last.to && one.from === one.to) last.insert += one.insert;
    else merged.push({ ...one });
  }
  return merged;
}

export interface NewBehavior {
  id: string;
  type: string;
  parameters?: [string, string][];
}

export function addBehavior(n: Network, behavior: NewBehavior, at?: Box): Splice[] {
  const lines = insertChild(n, behaviorLines(behavior), ["Behavior"]);
  return at === undefined ? lines : joined(lines, move(n, new Map([[behavior.id, at]])));
}

function behaviorLines({ id, type, parameters = [] }: NewBehavior): string[] {
  const head = `<Behavior${written({ id, type })}`;
  if (parameters.length === 0) return [`${head}/>`];
  return [`${head}>`, ...parameters.map(([name, value]) => `${INDENT}<Parameter${written({ name, value })}/>`), "</Behavior>"];
}

function written(attributes: Record<string, string>): string {
  return Object.entries(attributes).map(([name, value]) => ` ${name}="${escape(value)}"`).join("");
}

export function addLink(n: Network, from: string, to: string): Splice[] {
  return insertChild(n, [`<Link${written({ from, to })}/>`], ["Behavior", "Link"]);
}

/** Behaviors with their links and places, links alone; a slot of the board goes with its links. */
export function remove(n: Network, ids: readonly string[], links: readonly Link[]): Splice[] {
  const gone = new Set(ids);
  const doomed = [
    ...n.behaviors.filter((one) => gone.has(one.id)).map((one) => one.element),
    ...n.links.filter((one) => [one.from, one.to].some((end) => gone.has(end) || (!end.startsWith("board.") && gone.has(ownerOf(end))))).map((one) => one.element),
    ...links.map((one) => one.element),
    ...boxElements(n).filter((one) => gone.has(attribute(one, "id") ?? "")),
  ];
  return withoutEmptyLayout(n, [...new Set(doomed)]);
}

function ownerOf(end: string): string {
  return end.split(".", 1)[0]!;
}

function boxElements(n: Network): Element[] {
  return layoutOf(n)?.children ?? [];
}

/** A layout that loses its last box goes as well. */
function withoutEmptyLayout(n: Network, doomed: Element[]): Splice[] {
  const layout = layoutOf(n);
  const isEmptied = layout && layout.children.length > 0 && layout.children.every((one) => doomed.includes(one));
  const hasRemarks = layout && /\S/.test(textBetween(n.text, layout));
  const all = isEmptied && !hasRemarks ? [...doomed.filter((one) => one.parent !== layout), layout] : doomed;
  return joined(all.map((one) => cut(n.text, one)));
}

/** What an element has between its children: comments, text. */
function textBetween(text: string, element: Element): string {
  let rest = "";
  let at = element.openTo;
  for (const child of element.children) {
    rest += text.slice(at, child.from);
    at = child.to;
  }
  return rest + text.slice(at, element.closeFrom);
}

/** An element with its line, where it has one of its own. */
function cut(text: string, { from, to }: Element): Splice {
  let start = from;
  while (start > 0 && " \t".includes(text[start - 1]!)) start--;
  let end = to;
  while (end < text.length && " \t".includes(text[end]!)) end++;
  if (text[end] === "\r") end++;
  const ownsLine = (start === 0 || text[start - 1] === "\n") && text[end] === "\n";
  return ownsLine ? { from: start, to: end + 1, insert: "" } : { from, to, insert: "" };
}

/** A new id, in its links and its place as well. */
export function rename(n: Network, id: string, newId: string): Splice[] {
  const renamed = (text: string) => (text === id || text.startsWith(`${id}.`) ? newId + text.slice(id.length) : text);
  const behaviors = n.behaviors.filter((one) => one.id === id).map((one) => replaceValue(one.element, "id", newId));
  const links = n.links.flatMap(({ from, to, element }) => [
    ...(renamed(from) === from ? [] : [replaceValue(element, "from", renamed(from))]),
    ...(renamed(to) === to ? [] : [replaceValue(element, "to", renamed(to))]),
  ]);
  const boxes = boxElements(n).filter((one) => attribute(one, "id") === id).map((one) => replaceValue(one, "id", newId));
  return joined([...behaviors, ...links, ...boxes]);
}

function replaceValue(element: Element, name: string, value: string): Splice {
  const found = element.attributes.find((one) => one.name === name)!;
  return { from: found.valueFrom, to: found.valueTo, insert: escape(value) };
}

/** Set a parameter, or take it out with null. */
export function setParameter(n: Network, id: string, name: string, value: string | null): Splice[] {
  const behavior = n.behaviors.find((one) => one.id === id);
  if (behavior === undefined) return [];
  const { element } = behavior;
  const found = element.children.find((one) => one.tag === "Parameter" && attribute(one, "name") === name);
  if (value === null) return found ? joined([dropLast(n.text, element, found)]) : [];
  if (!found) return insertInto(n.text, element, [`<Parameter${written({ name, value })}/>`], element.children.at(-1));
  if (attribute(found, "value") === value) return [];
  if (attribute(found, "value") !== undefined) return [replaceValue(found, "value", value)];
  const end = found.attributes.at(-1)!.to;
  return [{ from: end, to: end, insert: written({ value }) }];
}

/** A child; with the last one goes the closing tag, unless there is a comment before it. */
function dropLast(text: string, element: Element, child: Element): Splice {
  if (element.children.length > 1 || /\S/.test(textBetween(text, element))) return cut(text, child);
  return { from: element.openTo - 1, to: element.to, insert: "/>" };
}

const ROOT_ORDER = ["name", "invocation_interval"] as const;

/** Set an attribute of the network, or take it out with null. */
export function setAttribute(n: Network, name: (typeof ROOT_ORDER)[number], value: string | null): Splice[] {
  const { root } = n;
  const found = root.attributes.find((one) => one.name === name);
  if (value === null) return found ? [{ from: n.text.slice(0, found.from).trimEnd().length, to: found.to, insert: "" }] : [];
  if (found) return found.value === value ? [] : [replaceValue(root, name, value)];
  const before = root.attributes.find((one) => ROOT_ORDER.indexOf(one.name as typeof name) > ROOT_ORDER.indexOf(name));
  const at = before ? n.text.slice(0, before.from).trimEnd().length : (root.attributes.at(-1)?.to ?? root.from + 1 + root.tag.length);
  return [{ from: at, to: at, insert: written({ [name]: value }) }];
}

/** Place parts; only the lines of those that change are touched. */
export function move(n: Network, boxes: ReadonlyMap<string, Box>): Splice[] {
  const known = new Map(boxElements(n).map((one) => [attribute(one, "id") ?? "", one]));
  const changed: Splice[] = [];
  const fresh: string[] = [];
  for (const [id, { x, y }] of boxes) {
    const element = known.get(id);
    const place = { x: String(Math.round(x)), y: String(Math.round(y)) };
    if (element === undefined) fresh.push(`<Box${written({ id, ...place })}/>`);
    else
      for (const [name, value] of Object.entries(place)) {
        if (attribute(element, name) === value) continue;
        if (attribute(element, name) !== undefined) changed.push(replaceValue(element, name, value));
        else changed.push({ from: element.attributes.at(-1)!.to, to: element.attributes.at(-1)!.to, insert: written({ [name]: value }) });
      }
  }
  if (fresh.length === 0) return joined(changed);
  const layout = layoutOf(n);
  const lines = layout ? insertInto(n.text, layout, fresh, layout.children.at(-1)) : insertChild(n, ["<Layout>", ...fresh.map((line) => INDENT + line), "</Layout>"], null);
  return joined(changed, lines);
}

/** Lines as a child of the root: behind the last of these tags, before all others; null is last. */
function insertChild(n: Network, lines: string[], tags: readonly string[] | null): Splice[] {
  const { children } = n.root;
  const before = tags === null ? children.at(-1) : children.findLast((one) => tags.includes(one.tag));
  return insertInto(n.text, n.root, lines, before);
}

/** Lines as children of an element, behind one of them, or else as its first. */
function insertInto(text: string, parent: Element, lines: string[], before: Element | undefined): Splice[] {
  const newline = text.includes("\r\n") ? "\r\n" : "\n";
  const outer = indentOf(text, parent.from);
  const indent = before ? indentOf(text, before.from) : outer + INDENT;
  const block = lines.map((line) => indent + line).join(newline);
  if (before) {
    // Behind a comment that shares its line.
    const rest = /^[ \t]*<!--(?:(?!-->)[^\n])*-->/.exec(text.slice(before.to, before.to + 500))?.[0] ?? "";
    const at = before.to + rest.length;
    return [{ from: at, to: at, insert: newline + block }];
  }
  if (parent.to === parent.openTo) return [{ from: parent.to - 2, to: parent.to, insert: `>${newline}${block}${newline}${outer}</${parent.tag}>` }];
  const first = parent.children[0];
  if (first) {
    const at = lineStart(text, first.from);
    return [{ from: at, to: at, insert: block + newline }];
  }
  const inside = text.slice(parent.openTo, parent.closeFrom);
  if (!/\S/.test(inside)) return [{ from: parent.openTo, to: parent.closeFrom, insert: `${newline}${block}${newline}${outer}` }];
  // A comment alone: what is new comes behind it.
  const at = parent.openTo + inside.trimEnd().length;
  return [{ from: at, to: at, insert: newline + block }];
}

function lineStart(text: string, at: number): number {
  return text.lastIndexOf("\n", at - 1) + 1;
}

function indentOf(text: string, at: number): string {
  return /^[ \t]*/.exec(text.slice(lineStart(text, at), at))![0];
}

/** Behaviors with the links among them and their places, as a network. */
export function copy(n: Network, ids: readonly string[]): string {
  const wanted = new Set(ids);
  const behaviors = n.behaviors.filter((one) => wanted.has(one.id));
  const isInside = (end: string) => end.startsWith("board.") || wanted.has(ownerOf(end));
  const links = n.links.filter(({ from, to }) => isInside(from) && isInside(to) && !(from.startsWith("board.") && to.startsWith("board.")));
  const boxes = new Map([...n.boxes].filter(([id]) => behaviors.some((one) => one.id === id)));
  let made = readNetwork(EMPTY);
  for (const { id, type, parameters } of behaviors) made = readNetwork(applySplices(made.text, addBehavior(made, { id, type, parameters: [...parameters] })));
  for (const { from, to } of links) made = readNetwork(applySplices(made.text, addLink(made, from, to)));
  return applySplices(made.text, move(made, boxes));
}

/** What was copied, under ids that are free. Raises XmlError for a text that is not XML. */
export function paste(n: Network, fragment: string, shift: Box): { splices: Splice[]; ids: string[] } {
  const given = readNetwork(fragment);
  const names = new Map<string, string>();
  const taken = new Set(n.behaviors.map((one) => one.id));
  for (const { id } of given.behaviors) {
    const name = freeAmong(taken, id);
    taken.add(name);
    names.set(id, name);
  }
  const renamed = (end: string) => (end.startsWith("board.") ? end : (names.get(ownerOf(end)) ?? ownerOf(end)) + end.slice(ownerOf(end).length));
  const behaviors = given.behaviors.flatMap(({ id, type, parameters }) => behaviorLines({ id: names.get(id)!, type, parameters: [...parameters] }));
  const known = new Set(n.links.map(({ from, to }) => `${from} -> ${to}`));
  const links = given.links.map(({ from, to }) => ({ from: renamed(from), to: renamed(to) })).filter(({ from, to }) => !known.has(`${from} -> ${to}`));
  const boxes = new Map([...given.boxes].filter(([id]) => names.has(id)).map(([id, { x, y }]) => [names.get(id)!, { x: x + shift.x, y: y + shift.y }]));
  if (behaviors.length === 0) return { splices: [], ids: [] };
  // One insertion behind another at the same place keeps this order.
  let made = n;
  const steps: ((now: Network) => Splice[])[] = [
    (now) => insertChild(now, behaviors, ["Behavior"]),
    ...(links.length ? [(now: Network) => insertChild(now, links.map((one) => `<Link${written(one)}/>`), ["Behavior", "Link"])] : []),
    (now) => move(now, boxes),
  ];
  for (const step of steps) made = readNetwork(applySplices(made.text, step(made)));
  return { splices: [stretch(n.text, made.text)], ids: [...names.values()] };
}

/** The one stretch in which two texts differ. */
export function stretch(before: string, after: string): Splice {
  const most = Math.min(before.length, after.length);
  let from = 0;
  while (from < most && before[from] === after[from]) from++;
  let behind = 0;
  while (behind < most - from && before[before.length - 1 - behind] === after[after.length - 1 - behind]) behind++;
  return { from, to: before.length - behind, insert: after.slice(from, after.length - behind) };
}

export function freeId(n: Network, wish: string): string {
  return freeAmong(new Set(n.behaviors.map((one) => one.id)), wish);
}

function freeAmong(taken: ReadonlySet<string>, wish: string): string {
  if (!taken.has(wish)) return wish;
  const stem = wish.replace(/\d+$/, "") || wish;
  let number = 2;
  while (taken.has(`${stem}${number}`)) number++;
  return `${stem}${number}`;
}

/** `Hri.SimpleCamera` is `simple_camera`. */
export function idFor(type: string): string {
  const name = type.split(".").at(-1)!;
  return name.replace(/(?<=[a-z0-9])(?=[A-Z])|(?<=[A-Z])(?=[A-Z][a-z])/g, "_").replace(/\W/g, "_").toLowerCase() || "behavior";
}
