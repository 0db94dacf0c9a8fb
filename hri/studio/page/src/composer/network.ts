// A behavior network as its text has it. It bears what a check would refuse.

import { attribute, parseXml, type Element } from "./xml";

export interface Behavior {
  id: string;
  type: string;
  parameters: Map<string, string>;
  element: Element;
}

export interface Link {
  from: string;
  to: string;
  element: Element;
}

/** The upper left corner of a part on the canvas, in pixels. */
export interface Box {
  x: number;
  y: number;
}

export interface Network {
  text: string;
  root: Element;
  name: string | undefined;
  interval: string | undefined;
  behaviors: Behavior[];
  links: Link[];
  boxes: Map<string, Box>;
}

/** Pixels, as the files have them. */
const WHOLE = /^-?\d{1,6}$/;

export const EMPTY = `<?xml version="1.0" encoding="UTF-8"?>
<BehaviorNetwork/>
`;

/** Raises XmlError where the text is not well-formed. */
export function readNetwork(text: string): Network {
  const root = parseXml(text);
  const network: Network = {
    text,
    root,
    name: attribute(root, "name"),
    interval: attribute(root, "invocation_interval"),
    behaviors: [],
    links: [],
    boxes: new Map(),
  };
  for (const element of root.children) {
    const value = (name: string) => attribute(element, name) ?? "";
    if (element.tag === "Behavior") network.behaviors.push({ id: value("id"), type: value("type"), parameters: parametersOf(element), element });
    else if (element.tag === "Link") network.links.push({ from: value("from"), to: value("to"), element });
    else if (element.tag === "Layout") for (const box of element.children) readBox(network.boxes, box);
  }
  return network;
}

function parametersOf(element: Element): Map<string, string> {
  const named = element.children.filter((one) => one.tag === "Parameter");
  return new Map(named.map((one) => [attribute(one, "name") ?? "", attribute(one, "value") ?? ""]));
}

function readBox(boxes: Map<string, Box>, element: Element): void {
  const [id, x, y] = ["id", "x", "y"].map((name) => attribute(element, name));
  if (element.tag === "Box" && id !== undefined && WHOLE.test(x ?? "") && WHOLE.test(y ?? "")) boxes.set(id, { x: Number(x), y: Number(y) });
}

/** The elements of the layout; more than one is a mistake that a person may have made. */
export function layoutsOf(network: Network): Element[] {
  return network.root.children.filter((one) => one.tag === "Layout");
}

/** Whether an end of a link is a slot of the board. */
export function isSlot(end: string): boolean {
  return end.startsWith("board.");
}

/** The part that an end of a link belongs to: the id of a behavior, or the slot itself. */
export function ownerOf(end: string): string {
  return isSlot(end) ? end : end.split(".", 1)[0]!;
}
