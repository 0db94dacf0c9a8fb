// The values of a network that runs, as they come: written straight into the page, at up to 20 Hz.

import type { Values } from "../topics";
import { Store } from "./store";

/** Of each port, for the curve that is shown beside it: ten seconds at 20 Hz. */
const MOST_POINTS = 200;
/** Letters. */
const LONGEST_ON_WIRE = 13;
const LONGEST = 60;

export type RunningNetwork = NonNullable<Values["networks"]>[number];
type Sample = NonNullable<Values["ports"]>[string];

export class LiveValues {
  /** All networks that run on the robot. */
  readonly networks = new Store<RunningNetwork[]>([]);
  /** Counts samples, for what is not written straight into the page. */
  readonly count = new Store(0);
  /** The way back to what decided, by `network/behavior.port`. */
  readonly reasons = new Store<NonNullable<Values["reasons"]>>({});
  readonly thumbnails = new Store<Record<string, string>>({});
  sample: Sample | null = null;
  private readonly shown = new Map<string, Set<Element>>();
  private readonly costs = new Map<string, Element>();
  private readonly curves = new Map<string, number[]>();
  private followed = "";

  /** Follow a network by name; "" for none. */
  follow(name: string): void {
    if (name === this.followed) return;
    this.followed = name;
    this.sample = null;
    this.curves.clear();
    this.thumbnails.set({});
    this.reasons.set({});
    for (const element of [...[...this.shown.values()].flatMap((all) => [...all]), ...this.costs.values()]) write(element, "");
  }

  get name(): string {
    return this.followed;
  }

  /** Take the newest values of the topics. */
  take(networks: RunningNetwork[], ports: Values["ports"], thumbnails: Values["thumbnails"], reasons: Values["reasons"]): void {
    this.networks.set(networks);
    if (thumbnails) this.thumbnails.set(thumbnails);
    if (reasons) this.reasons.set(reasons);
    const sample = ports?.[this.followed];
    if (sample === undefined || sample === this.sample) return;
    this.sample = sample;
    for (const [port, value] of Object.entries(sample.values)) {
      const number = asNumber(value);
      if (number !== null) this.keep(port, number);
      for (const element of this.shown.get(port) ?? []) write(element, onWire(value));
    }
    for (const [id, [last, , , missed]] of Object.entries(sample.cost)) {
      const element = this.costs.get(id);
      if (!element) continue;
      const isResting = sample.resting.includes(id);
      write(element, isResting ? "rests after an error" : `${Math.round(last!)} µs${missed ? `, ${missed} missed` : ""}`);
      element.classList.toggle("late", isResting || missed! > 0);
    }
    this.count.set(this.count.value + 1);
  }

  private keep(port: string, number: number): void {
    const curve = this.curves.get(port) ?? [];
    this.curves.set(port, curve);
    curve.push(number);
    if (curve.length > MOST_POINTS) curve.shift();
  }

  curve(port: string): readonly number[] {
    return this.curves.get(port) ?? [];
  }

  /** Show the value of a port in an element; gives what ends it. */
  show(port: string, element: Element): () => void {
    const all = this.shown.get(port) ?? new Set();
    this.shown.set(port, all.add(element));
    if (this.sample && port in this.sample.values) write(element, onWire(this.sample.values[port]));
    return () => all.delete(element);
  }

  showCost(id: string, element: Element): () => void {
    this.costs.set(id, element);
    return () => {
      if (this.costs.get(id) === element) this.costs.delete(id);
    };
  }
}

function write(element: Element, words: string): void {
  if (element.textContent !== words) element.textContent = words;
}

function asNumber(value: unknown): number | null {
  if (typeof value === "number") return value;
  return typeof value === "boolean" ? Number(value) : null;
}

/** What fits on a wire; more is shown where one points. */
function onWire(value: unknown): string {
  const words = inWords(value);
  return words.length > LONGEST_ON_WIRE ? `${words.slice(0, LONGEST_ON_WIRE - 1)}…` : words;
}

/** A value in a few letters. */
export function inWords(value: unknown): string {
  if (value === null || value === undefined) return "–";
  if (typeof value === "number") return Number.isInteger(value) ? String(value) : value.toPrecision(4).replace(/\.?0+$/, "");
  if (typeof value === "boolean") return value ? "true" : "false";
  if (typeof value === "string") return value.length > LONGEST ? `“${value.slice(0, LONGEST - 1)}…”` : `“${value}”`;
  const told = value as { kind?: string; shape?: number[]; head?: number[]; width?: number; height?: number; text?: string };
  if (told.kind === "array") return `[${(told.head ?? []).slice(0, 3).map((one) => inWords(one)).join(" ")}${(told.shape?.[0] ?? 0) > 3 ? " …" : ""}]`;
  if (told.kind === "image") return `${told.width}×${told.height}`;
  const text = told.text ?? "";
  return text.length > LONGEST ? `${text.slice(0, LONGEST - 1)}…` : text;
}
