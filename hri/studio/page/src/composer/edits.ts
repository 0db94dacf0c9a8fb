// The commands of the composer as splices of the text: what they do not mean stays as it is, byte
// by byte. What they write is written as `hri network format` would.

import { attribute, escape, type Element } from "./xml";
import { EMPTY, isSlot, layoutsOf, ownerOf, readNetwork, type Box, type Link, type Network } from "./network";

/** Offsets in the text before. */
export interface Splice {
  from: number;
  to: number;
  insert: string;
}

const INDENT = "  ";
/** Pixels from the middle: what a layout can say. */
const FARTHEST = 999_999;

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

/** The one stretch in which two texts differ. */
export function stretch(before: string, after: string): Splice {
  const most = Math.min(before.length, after.length);
  let from = 0;
  while (from < most && before[from] === after[from]) from++;
  let behind = 0;
  while (behind < most - from && before[before.length - 1 - behind] === after[after.length - 1 - behind]) behind++;
  return { from, to: before.length - behind, insert: after.slice(from, after.length - behind) };
}

function inOrder(...all: Splice[][]): Splice[] {
  return all.flat().sort((a, b) => a.from - b.from || a.to - b.to);
}

/** Commands one after the other, as the stretch of the text that they change. */
function inTurn(n: Network, ...steps: ((now: Network) => Splice[])[]): Splice[] {
  let made = n;
  for (const step of steps) made = readNetwork(applySplices(made.text, step(made)));
  return made.text === n.text ? [] : [stretch(n.text, made.text)];
}

export interface NewBehavior {
  id: string;
  type: string;
  parameters?: Iterable<[string, string]>;
}

export function addBehavior(n: Network, behavior: NewBehavior, at?: Box): Splice[] {
  return addAll(n, [behavior], [], at ? new Map([[behavior.id, at]]) : new Map());
}

export function addLink(n: Network, from: string, to: string): Splice[] {
  return addAll(n, [], [{ from, to }], new Map());
}

function addAll(n: Network, behaviors: readonly NewBehavior[], links: readonly Pick<Link, "from" | "to">[], boxes: ReadonlyMap<string, Box>): Splice[] {
  const lines = links.map(({ from, to }) => `<Link${written({ from, to })}/>`);
  return inTurn(
    n,
    (now) => insertChild(now, behaviors.flatMap(behaviorLines), ["Behavior"]),
    (now) => insertChild(now, lines, ["Behavior", "Link"]),
    (now) => move(now, boxes),
  );
}

function behaviorLines({ id, type, parameters = [] }: NewBehavior): string[] {
  const head = `<Behavior${written({ id, type })}`;
  const inside = [...parameters].map(([name, value]) => `${INDENT}<Parameter${written({ name, value })}/>`);
  return inside.length === 0 ? [`${head}/>`] : [`${head}>`, ...inside, "</Behavior>"];
}

function written(attributes: Record<string, string>): string {
  return Object.entries(attributes).map(([name, value]) => ` ${name}="${escape(value)}"`).join("");
}

/** Behaviors with their links and places, links alone; a slot of the board goes with its links. */
export function remove(n: Network, ids: readonly string[], links: readonly Link[]): Splice[] {
  const gone = new Set(ids);
  const lost = n.links.filter((one) => gone.has(ownerOf(one.from)) || gone.has(ownerOf(one.to)));
  return without(n.text, [
    ...[...n.behaviors.filter((one) => gone.has(one.id)), ...lost, ...links].map((one) => one.element),
    ...boxElements(n).filter((one) => gone.has(attribute(one, "id") ?? "")),
  ]);
}

function boxElements(n: Network): Element[] {
  return layoutsOf(n).flatMap((one) => one.children.filter((child) => child.tag === "Box"));
}

/** Take elements out; what is then empty is closed by its own tag, and a layout goes as well. */
function without(text: string, elements: Iterable<Element>): Splice[] {
  const byParent = new Map<Element, Set<Element>>();
  const doom = (element: Element): void => {
    const siblings = byParent.get(element.parent!) ?? new Set();
    byParent.set(element.parent!, siblings.add(element));
  };
  for (const element of elements) doom(element);
  for (const [parent, doomed] of byParent)
    if (parent.tag === "Layout" && parent.parent && isAllOf(text, parent, doomed)) {
      byParent.delete(parent);
      doom(parent);
    }
  return inOrder(
    ...[...byParent].map(([parent, doomed]) =>
      isAllOf(text, parent, doomed) ? [{ from: parent.openTo - 1, to: parent.to, insert: "/>" }] : cuts(text, parent, doomed),
    ),
  );
}

/** Whether an element has nothing but these children: no others, no comment. */
function isAllOf(text: string, parent: Element, children: ReadonlySet<Element>): boolean {
  return parent.children.every((one) => children.has(one)) && !/\S/.test(textBetween(text, parent));
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

/** Children without their lines; of two blank lines that then meet, one goes as well. */
function cuts(text: string, parent: Element, doomed: ReadonlySet<Element>): Splice[] {
  const runs: { from: number; to: number }[] = [];
  for (const { from, to } of parent.children.filter((one) => doomed.has(one))) {
    const last = runs.at(-1);
    if (last && !/\S/.test(text.slice(last.to, from))) last.to = to;
    else runs.push({ from, to });
  }
  return runs.map((run) => ({ ...lines(text, parent, run), insert: "" }));
}

/** A stretch with the lines that it has for itself. */
function lines(text: string, parent: Element, { from, to }: { from: number; to: number }): { from: number; to: number } {
  const start = lineStart(text, from);
  const rest = /^[ \t]*\r?\n/.exec(text.slice(to, to + 500))?.[0];
  if (rest === undefined || /\S/.test(text.slice(start, from))) return { from, to };
  const end = to + rest.length;
  const blankBefore = /\n[ \t]*\r?\n$/.exec(text.slice(Math.max(parent.openTo, start - 500), start))?.[0].slice(1) ?? "";
  const blankAfter = /^[ \t]*\r?\n/.exec(text.slice(end, parent.closeFrom))?.[0] ?? "";
  const isFirst = !/\S/.test(text.slice(parent.openTo, start));
  const isLast = !/\S/.test(text.slice(end, parent.closeFrom));
  if (isLast) return { from: start - blankBefore.length, to: end };
  return { from: start, to: isFirst || blankBefore ? end + blankAfter.length : end };
}

/** A new id, in its links and its place as well. */
export function rename(n: Network, id: string, newId: string): Splice[] {
  if (newId === id) return [];
  const renamed = (end: string) => (!isSlot(end) && ownerOf(end) === id ? newId + end.slice(id.length) : end);
  const boxes = boxElements(n);
  const own = boxes.filter((one) => attribute(one, "id") === id);
  // The place of one that is gone would be another place for this one.
  const stale = own.length > 0 ? boxes.filter((one) => attribute(one, "id") === newId) : [];
  return inOrder(
    ...n.behaviors.filter((one) => one.id === id).map((one) => put(n.text, one.element, "id", newId)),
    ...n.links.flatMap(({ from, to, element }) => [put(n.text, element, "from", renamed(from)), put(n.text, element, "to", renamed(to))]),
    ...own.map((one) => put(n.text, one, "id", newId)),
    without(n.text, stale),
  );
}

/** Set an attribute; a new one comes last. */
function put(text: string, element: Element, name: string, value: string): Splice[] {
  const found = element.attributes.find((one) => one.name === name);
  if ((found?.value ?? "") === value) return [];
  if (found === undefined) return [insertion(endOfAttributes(element), written({ [name]: value }))];
  if (text[found.valueTo] === '"') return [{ from: found.valueFrom, to: found.valueTo, insert: escape(value) }];
  return [{ from: found.from, to: found.to, insert: written({ [name]: value }).slice(1) }];
}

function insertion(at: number, insert: string): Splice {
  return { from: at, to: at, insert };
}

function endOfAttributes(element: Element): number {
  return element.attributes.at(-1)?.to ?? element.from + 1 + element.tag.length;
}

/** Set a parameter, or take it out with null. */
export function setParameter(n: Network, id: string, name: string, value: string | null): Splice[] {
  const element = n.behaviors.find((one) => one.id === id)?.element;
  if (element === undefined) return [];
  const found = element.children.filter((one) => one.tag === "Parameter" && attribute(one, "name") === name);
  if (value === null) return without(n.text, found);
  const last = found.at(-1);
  if (last) return put(n.text, last, "value", value);
  return insertInto(n.text, element, [`<Parameter${written({ name, value })}/>`], element.children.at(-1));
}

const ROOT_ORDER = ["name", "invocation_interval"] as const;

/** Set an attribute of the network, or take it out with null. */
export function setAttribute(n: Network, name: (typeof ROOT_ORDER)[number], value: string | null): Splice[] {
  const { root, text } = n;
  const behind = (at: number) => text.slice(0, at).trimEnd().length;
  const found = root.attributes.find((one) => one.name === name);
  if (value === null) return found ? [{ from: behind(found.from), to: found.to, insert: "" }] : [];
  if (found) return put(text, root, name, value);
  const later = root.attributes.find((one) => (ROOT_ORDER as readonly string[]).indexOf(one.name) > ROOT_ORDER.indexOf(name));
  return [insertion(later ? behind(later.from) : endOfAttributes(root), written({ [name]: value }))];
}

/** Place parts; only the lines of those that change are touched. */
export function move(n: Network, boxes: ReadonlyMap<string, Box>): Splice[] {
  const known = new Map(boxElements(n).map((one) => [attribute(one, "id") ?? "", one]));
  const changed: Splice[][] = [];
  const fresh: string[] = [];
  for (const [id, box] of boxes) {
    const element = known.get(id);
    const [x, y] = [pixels(box.x), pixels(box.y)];
    if (element === undefined) fresh.push(`<Box${written({ id, x, y })}/>`);
    else changed.push(put(n.text, element, "x", x), put(n.text, element, "y", y));
  }
  const layout = layoutsOf(n)[0];
  const added = layout
    ? insertInto(n.text, layout, fresh, layout.children.at(-1))
    : insertChild(n, fresh.length > 0 ? ["<Layout>", ...fresh.map((line) => INDENT + line), "</Layout>"] : [], null);
  return inOrder(...changed, added);
}

function pixels(value: number): string {
  return String(Math.max(-FARTHEST, Math.min(FARTHEST, Math.round(value))) || 0);
}

/** Lines as a child of the root: behind the last of these tags, before all others; null is last. */
function insertChild(n: Network, lines: string[], tags: readonly string[] | null): Splice[] {
  const { children } = n.root;
  const before = tags === null ? children.at(-1) : children.findLast((one) => tags.includes(one.tag));
  return insertInto(n.text, n.root, lines, before);
}

/** Lines as children of an element, behind one of them, or else before all others. */
function insertInto(text: string, parent: Element, lines: string[], before: Element | undefined): Splice[] {
  if (lines.length === 0) return [];
  const newline = text.includes("\r\n") ? "\r\n" : "\n";
  const outer = indentOf(text, parent.from);
  const first = parent.children[0];
  const indent = before || (first && ownsLineStart(text, first.from)) ? indentOf(text, (before ?? first)!.from) : outer + INDENT;
  const block = lines.map((line) => indent + line).join(newline);
  if (before) {
    // Behind a comment that shares its line.
    const rest = /^[ \t]*<!--(?:(?!-->)[^\n])*-->/.exec(text.slice(before.to, before.to + 500))?.[0] ?? "";
    return [insertion(before.to + rest.length, newline + block)];
  }
  if (parent.to === parent.openTo) return [{ from: parent.to - 2, to: parent.to, insert: `>${newline}${block}${newline}${outer}</${parent.tag}>` }];
  if (first && ownsLineStart(text, first.from)) return [insertion(lineStart(text, first.from), block + newline)];
  if (first) return [insertion(first.from, newline + block + newline + indent)];
  const inside = text.slice(parent.openTo, parent.closeFrom);
  if (!/\S/.test(inside)) return [{ from: parent.openTo, to: parent.closeFrom, insert: `${newline}${block}${newline}${outer}` }];
  // A comment alone: what is new comes behind it.
  return [insertion(parent.openTo + inside.trimEnd().length, newline + block)];
}

function lineStart(text: string, at: number): number {
  return text.lastIndexOf("\n", at - 1) + 1;
}

function indentOf(text: string, at: number): string {
  return /^[ \t]*/.exec(text.slice(lineStart(text, at), at))![0];
}

function ownsLineStart(text: string, at: number): boolean {
  return !/\S/.test(text.slice(lineStart(text, at), at));
}

/** Behaviors with the links among them and their places, as a network. */
export function copy(n: Network, ids: readonly string[]): string {
  const behaviors = n.behaviors.filter((one) => ids.includes(one.id));
  const names = new Set(behaviors.map((one) => one.id));
  const isInside = (end: string) => isSlot(end) || names.has(ownerOf(end));
  const links = n.links.filter(({ from, to }) => isInside(from) && isInside(to) && !(isSlot(from) && isSlot(to)));
  const boxes = new Map([...n.boxes].filter(([id]) => names.has(id)));
  return applySplices(EMPTY, addAll(readNetwork(EMPTY), behaviors, links, boxes));
}

/** What was copied, under ids that are free. Raises XmlError for a text that is not XML. */
export function paste(n: Network, fragment: string, shift: Box): { splices: Splice[]; ids: string[] } {
  const given = readNetwork(fragment);
  const names = new Map<string, string>();
  const taken = takenIds(n);
  for (const { id, type } of given.behaviors) {
    const name = freeAmong(taken, id || idFor(type));
    taken.add(name);
    names.set(id, name);
  }
  const renamed = (end: string) => (isSlot(end) ? end : (names.get(ownerOf(end)) ?? ownerOf(end)) + end.slice(ownerOf(end).length));
  const behaviors = given.behaviors.map((one) => ({ ...one, id: names.get(one.id)! }));
  const known = new Set(n.links.map(({ from, to }) => `${from} -> ${to}`));
  const links = given.links.map(({ from, to }) => ({ from: renamed(from), to: renamed(to) })).filter(({ from, to }) => !known.has(`${from} -> ${to}`));
  const boxes = new Map([...given.boxes].filter(([id]) => names.has(id)).map(([id, { x, y }]) => [names.get(id)!, { x: x + shift.x, y: y + shift.y }]));
  return behaviors.length === 0 ? { splices: [], ids: [] } : { splices: addAll(n, behaviors, links, boxes), ids: [...names.values()] };
}

export function freeId(n: Network, wish: string): string {
  return freeAmong(takenIds(n), wish);
}

/** The board is not a behavior, but links name it like one. */
function takenIds(n: Network): Set<string> {
  return new Set([...n.behaviors.map((one) => one.id), "board"]);
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
