// What the page knows of the robot: plain values, and how a message changes them. No browser here.

export type Place = [number, number];

export interface About {
  api: number;
  app: string;
  about: string;
  is_simulated: boolean;
  has_base: boolean;
}

export interface Feeling {
  label: string;
  words: string;
  why: string;
  pleasure: number;
  arousal: number;
  dominance: number;
  emotions: Record<string, number>;
  drives: Record<string, number>;
  causes: { name: string; share: number; person: string }[];
}

export interface Person {
  id: string;
  name: string;
  distance: number | null;
  bearing: number;
  engagement: string;
  is_looking: boolean;
  is_attended: boolean;
  box: [number, number, number, number] | null;
}

export interface Base {
  pose: [number, number, number] | null;
  velocity: Place | null;
  battery: number | null;
  is_stopped: boolean;
  why: string;
  ranges: { id: string; at: [number, number, number]; distance: number | null }[];
}

export interface World {
  walls: [number, number, number, number][];
  circles: [number, number, number][];
  people: { name: string; at: Place; is_present: boolean }[];
  things: { name: string; at: Place }[];
}

export interface Values {
  about?: About;
  speech?: { is_hearing: boolean; is_muted: boolean; is_speaking: boolean };
  feeling?: Feeling | null;
  people?: { is_watching: boolean; is_on: boolean; persons: Person[] };
  base?: Base;
  world?: World | null;
  devices?: { id: string; says: string; stand_in: string }[];
}

export interface RobotEvent {
  t: number;
  event: string;
  [key: string]: unknown;
}

export interface Line {
  time: number;
  who: "person" | "robot" | "ignored";
  text: string;
  detail: string;
}

export interface Mood {
  time: number;
  pleasure: number;
  arousal: number;
  dominance: number;
}

export interface State {
  values: Values;
  lines: Line[];
  events: RobotEvent[];
  moods: Mood[];
}

export const MOST_LINES = 200;
export const MOST_EVENTS = 300;
/** Five minutes, twice a second. */
export const MOST_MOODS = 600;
const MOOD_EVERY = 0.5;

export function empty(): State {
  return { values: {}, lines: [], events: [], moods: [] };
}

/** Take a message of the robot; `now` is in seconds, of the page. */
export function take(state: State, message: unknown, now: number): void {
  const told = message as { topic?: keyof Values; value?: unknown; event?: RobotEvent };
  if (told.topic !== undefined) {
    (state.values as Record<string, unknown>)[told.topic] = told.value;
    if (told.topic === "feeling") note(state, now);
  } else if (told.event !== undefined) {
    keep(state.events, told.event, MOST_EVENTS);
    const line = lineOf(told.event);
    if (line !== null) keep(state.lines, line, MOST_LINES);
  }
}

/** The mood goes on also while nothing changes. */
export function note(state: State, now: number): void {
  const feeling = state.values.feeling;
  const last = state.moods.at(-1);
  if (!feeling || (last !== undefined && now - last.time < MOOD_EVERY)) return;
  const { pleasure, arousal, dominance } = feeling;
  keep(state.moods, { time: now, pleasure, arousal, dominance }, MOST_MOODS);
}

function keep<T>(list: T[], item: T, most: number): void {
  list.push(item);
  if (list.length > most) list.splice(0, list.length - most);
}

export function lineOf(event: RobotEvent): Line | null {
  const text = String(event.text ?? "");
  const sure = typeof event.confidence === "number" ? `${Math.round(event.confidence * 100)} % sure` : "";
  switch (event.event) {
    case "speech.heard":
      return { time: event.t, who: "person", text, detail: sure };
    case "speech.rejected":
      return { time: event.t, who: "ignored", text: "ignored", detail: String(event.reason ?? "") };
    case "speech.said":
      return { time: event.t, who: "robot", text, detail: "" };
    default:
      return null;
  }
}

/** The properties of an event in one line. */
export function summary(event: RobotEvent): string {
  return Object.entries(event)
    .filter(([key]) => key !== "t" && key !== "event")
    .map(([key, value]) => `${key} ${typeof value === "object" ? JSON.stringify(value) : value}`)
    .join(", ");
}

/** The bounds of a room with a margin: left, bottom, width, height in meters. */
export function bounds(world: World | null | undefined, base: Base | undefined): [number, number, number, number] {
  const xs: number[] = [];
  const ys: number[] = [];
  for (const [x1, y1, x2, y2] of world?.walls ?? []) {
    xs.push(x1, x2);
    ys.push(y1, y2);
  }
  for (const [x, y] of [base?.pose ?? [0, 0], ...(world?.people.map((one) => one.at) ?? [])]) {
    xs.push(x! - 1, x! + 1);
    ys.push(y! - 1, y! + 1);
  }
  const left = Math.min(...xs) - 0.3;
  const low = Math.min(...ys) - 0.3;
  return [left, low, Math.max(...xs) + 0.3 - left, Math.max(...ys) + 0.3 - low];
}
