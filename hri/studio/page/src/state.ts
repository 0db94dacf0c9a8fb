// What the page knows of the robot: plain values, and how a message changes them. No browser here.

import type { Base, RobotEvent, Saying, Values, World } from "./topics";

export type * from "./topics";

export interface Line {
  time: number;
  who: "person" | "robot" | "ignored";
  text: string;
  detail: string;
}

export interface State {
  values: Values;
  lines: Line[];
  events: RobotEvent[];
}

export const MOST_LINES = 200;
export const MOST_EVENTS = 300;
export function empty(): State {
  return { values: {}, lines: [], events: [] };
}

/** The server tells the last events to each page that comes, also to one that comes back. */
export function forgetEvents(state: State): void {
  state.lines = [];
  state.events = [];
}

/** Take a message of the robot. */
export function take(state: State, message: unknown): void {
  const told = message as { topic?: keyof Values; value?: unknown; event?: RobotEvent };
  if (told.topic !== undefined) {
    (state.values as Record<string, unknown>)[told.topic] = told.value;
  } else if (told.event !== undefined) {
    state.events = withLast(state.events, told.event, MOST_EVENTS);
    const line = lineOf(told.event);
    if (line !== null) state.lines = withLast(state.lines, line, MOST_LINES);
  }
}

/** A new list, since the page draws what is not the same as before. */
function withLast<T>(list: readonly T[], item: T, most: number): T[] {
  return [...list.slice(Math.max(0, list.length + 1 - most)), item];
}

export function lineOf(event: RobotEvent): Line | null {
  const text = String(event.text ?? "");
  const sure = typeof event.confidence === "number" ? `${Math.round(event.confidence * 100)} % sure` : "";
  switch (event.event) {
    case "speech.heard":
      return { time: event.t, who: "person", text, detail: sure };
    case "speech.rejected":
      return { time: event.t, who: "ignored", text: event.typed === true ? text : "ignored", detail: whyIgnored(event) };
    case "speech.said":
      return { time: event.t, who: "robot", text, detail: "" };
    default:
      return null;
  }
}

/** Why a sentence does not count; of one that was typed also what could have followed, and the nearest sentence. */
function whyIgnored(event: RobotEvent): string {
  const why = [event.reason, event.typed === true ? event.detail : ""].filter(Boolean).join(": ");
  return event.typed === true && event.nearest ? `${why}. Nearest: "${event.nearest}"` : why;
}

/** What can be said, of which some words or the rule have these letters; all without letters. */
export function matching(sayings: readonly Saying[], letters: string): Saying[] {
  const wanted = letters.trim().toLowerCase();
  return sayings.filter((one) => [one.rule, one.about, ...one.examples].some((text) => text.toLowerCase().includes(wanted)));
}

/** The properties of an event in one line. */
export function summary(event: RobotEvent): string {
  return Object.entries(event)
    .filter(([key]) => key !== "t" && key !== "event")
    .map(([key, value]) => `${key} ${typeof value === "object" ? JSON.stringify(value) : value}`)
    .join(", ");
}

/** Meters from the walls at which something still belongs to the room. */
const NEAR = 3;

/** What the map shows, with a margin: left, bottom, width, height in meters. It is the room, the robot,
 * and what is in the room or near it: nothing far away makes it small. */
export function bounds(world: World | null | undefined, base: Base | undefined): [number, number, number, number] {
  const xs: number[] = [];
  const ys: number[] = [];
  for (const [x1, y1, x2, y2] of world?.walls ?? []) {
    xs.push(x1!, x2!);
    ys.push(y1!, y2!);
  }
  const all = [...(world?.people ?? []), ...(world?.things ?? []), ...(world?.obstacles ?? [])];
  const isNear = ([x, y]: number[]): boolean => xs.length === 0 || (isWithin(x!, xs) && isWithin(y!, ys));
  const near = all.map((one) => one.at).filter(isNear);
  const middles = [base?.pose ?? [0, 0], ...near];
  for (const [x, y] of middles) {
    xs.push(x! - 1, x! + 1);
    ys.push(y! - 1, y! + 1);
  }
  const left = Math.min(...xs) - 0.3;
  const low = Math.min(...ys) - 0.3;
  return [left, low, Math.max(...xs) + 0.3 - left, Math.max(...ys) + 0.3 - low];
}

function isWithin(place: number, walls: number[]): boolean {
  return place >= Math.min(...walls) - NEAR && place <= Math.max(...walls) + NEAR;
}

/** Something in the simulated room that can be put elsewhere. */
export interface Movable {
  kind: "person" | "thing" | "obstacle";
  name: string;
  at: number[];
}

export function movables(world: World | null | undefined): Movable[] {
  const of = (kind: Movable["kind"], all: { name: string; at: number[] }[] | undefined) =>
    (all ?? []).map(({ name, at }) => ({ kind, name, at }));
  return [...of("person", world?.people), ...of("thing", world?.things), ...of("obstacle", world?.obstacles)];
}

/** The command that puts something there, in meters. */
export function putCommand(one: Pick<Movable, "kind" | "name">, x: number, y: number): [string, Record<string, unknown>] {
  if (one.kind === "person") return ["visitor_go", { x, y, ...(one.name ? { who: one.name } : {}) }];
  return [one.kind === "thing" ? "place" : "obstacle", { name: one.name, x, y }];
}

/** "obstacle 3", when there are two already. */
export function freeName(kind: string, all: readonly Movable[]): string {
  let number = 1;
  while (all.some((one) => one.name === `${kind} ${number}`)) number++;
  return `${kind} ${number}`;
}

/** "2 min ago" */
export function ago(seconds: number): string {
  return seconds < 60 ? `${Math.max(0, Math.round(seconds))} s ago` : `${Math.round(seconds / 60)} min ago`;
}
