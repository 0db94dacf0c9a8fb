// A recording as the page knows it: plain values, and what holds at a time. No browser here.

import { lineOf, type Line, type RobotEvent } from "./state";

export interface Mood {
  time: number;
  pleasure: number;
  arousal: number;
  dominance: number;
}

export interface Listed {
  folder: string;
  name: string;
  /** Seconds since 1970. */
  written: number;
  bytes: number;
  length: number;
  is_growing: boolean;
}

/** Times are seconds of the clock of the log. */
export interface About extends Listed {
  start: number;
  end: number;
  face: { start: number; length: number; rate: number } | null;
  sound: { start: number; length: number; bytes: number } | null;
  wrong: string[];
  words: Record<string, string>;
}

export interface Part {
  events: RobotEvent[];
  next: number;
  is_all: boolean;
  skipped: number;
}

export interface Mark {
  row: Row;
  from: number;
  to: number;
  kind: string;
  about: string;
}

export type Row = "heard" | "ignored" | "said" | "head" | "body";
export const ROWS: Record<Row, string> = { heard: "Heard", ignored: "Ignored", said: "Said", head: "Head", body: "Bumps, stops" };

export interface Recording {
  about: About;
  events: RobotEvent[];
  lines: Line[];
  moods: Mood[];
  feelings: { time: number; label: string }[];
  marks: Mark[];
  /** The last sentence that it said, which lasts until it has finished. */
  saying: Mark | null;
  skipped: number;
  /** Whether there are more events than the page holds. */
  isCut: boolean;
}

export const MOST_EVENTS = 20_000;
/** They come too often to be read, and have nothing to read. */
const LEFT_OUT = new Set(["odometry", "speech.partial", "recording.started"]);

export function begun(about: About): Recording {
  return { about, events: [], lines: [], moods: [], feelings: [], marks: [], saying: null, skipped: 0, isCut: false };
}

/** Take a part of the log. */
export function takePart(recording: Recording, part: Part): void {
  recording.skipped += part.skipped;
  for (const event of part.events) if (!LEFT_OUT.has(event.event)) takeEvent(recording, event);
}

function takeEvent(recording: Recording, event: RobotEvent): void {
  if (recording.events.length >= MOST_EVENTS) {
    recording.isCut = true;
    return;
  }
  recording.events.push(event);
  recording.about.end = Math.max(recording.about.end, event.t);
  const line = recordedLine(event);
  if (line !== null) recording.lines.push(line);
  const mood = moodOf(event);
  if (mood !== null) recording.moods.push(mood);
  if (event.event === "emotion.changed" && typeof event.label === "string") recording.feelings.push({ time: event.t, label: event.label });
  const mark = markOf(event);
  if (mark !== null) recording.marks.push(mark);
  if (mark?.row === "said") recording.saying = mark;
  if (event.event === "speech.finished" && recording.saying !== null) recording.saying.to = Math.max(event.t, recording.saying.from);
}

/** A line of the conversation; a recording may have the words that were rejected. */
function recordedLine(event: RobotEvent): Line | null {
  const line = lineOf(event);
  if (line?.who === "ignored" && event.text) line.text = String(event.text);
  return line;
}

function number(value: unknown): number | null {
  return typeof value === "number" && Math.abs(value) <= 1 ? value : null;
}

function moodOf(event: RobotEvent): Mood | null {
  const pleasure = event.event === "emotion.changed" ? number(event.valence) : event.event === "mood.changed" ? number(event.pleasure) : null;
  const arousal = number(event.arousal);
  const dominance = number(event.dominance);
  return pleasure === null || arousal === null || dominance === null ? null : { time: event.t, pleasure, arousal, dominance };
}

function markOf(event: RobotEvent): Mark | null {
  const at = (row: Row, about: string, from = event.t, to = event.t): Mark => ({ row, from, to, kind: event.event.replace(".", "-"), about });
  const text = String(event.text ?? "");
  switch (event.event) {
    case "speech.heard":
      return typeof event.start === "number" && typeof event.end === "number" ? at("heard", text, event.start, event.end) : at("heard", text);
    case "speech.rejected":
      return at("ignored", text || String(event.reason ?? ""));
    case "speech.said":
      return at("said", text);
    case "head.nodded":
      return at("head", "a nod");
    case "head.shaken":
      return at("head", "a shake of the head");
    case "bumper.pressed":
      return at("body", "bumped");
    case "drive.stopped":
      return event.reason === "done" || event.reason === "halt" ? null : at("body", String(event.words ?? event.reason ?? "stopped"));
    default:
      return null;
  }
}

/** The last of what has begun by a time, by number; -1 before the first. */
export function lastBy<T>(items: readonly T[], time: number, timeOf: (item: T) => number): number {
  let low = 0;
  let high = items.length;
  while (low < high) {
    const middle = (low + high) >> 1;
    if (timeOf(items[middle]!) <= time + 1e-6) low = middle + 1;
    else high = middle;
  }
  return low - 1;
}

/** What the robot was, after "I am". */
export function feelingAt(recording: Recording, time: number): string {
  const feeling = recording.feelings[lastBy(recording.feelings, time, (one) => one.time)];
  return feeling === undefined ? "" : recording.about.words[feeling.label] ?? feeling.label.replaceAll("_", " ");
}

/** Pleasure, arousal and dominance as the curves show them. */
export function moodAt(recording: Recording, time: number): Mood | null {
  const place = lastBy(recording.moods, time, (one) => one.time);
  const before = recording.moods[place];
  const after = recording.moods[place + 1] ?? before;
  if (before === undefined || after === undefined) return null;
  const span = after.time - before.time;
  const part = span > 0 ? (time - before.time) / span : 0;
  const mixed = (key: "pleasure" | "arousal" | "dominance") => before[key] + part * (after[key] - before[key]);
  return { time, pleasure: mixed("pleasure"), arousal: mixed("arousal"), dominance: mixed("dominance") };
}

/** Minutes and seconds, hours where there are any. */
export function clock(time: number, digits = 0): string {
  const scale = 10 ** digits;
  const shown = Math.floor(Math.max(0, time) * scale + 1e-6) / scale;
  const hours = Math.floor(shown / 3600);
  const minutes = Math.floor(shown / 60) % 60;
  const seconds = (shown % 60).toFixed(digits).padStart(digits ? digits + 3 : 2, "0");
  return hours ? `${hours}:${String(minutes).padStart(2, "0")}:${seconds}` : `${minutes}:${seconds}`;
}

/** The same for a screen reader. */
export function spoken(time: number): string {
  const minutes = Math.floor(Math.max(0, time) / 60);
  const seconds = Math.floor(Math.max(0, time) % 60);
  const told = `${seconds} second${seconds === 1 ? "" : "s"}`;
  return minutes ? `${minutes} minute${minutes === 1 ? "" : "s"} ${told}` : told;
}

export function size(bytes: number): string {
  return bytes < 1e6 ? `${Math.ceil(bytes / 1e3)} kB` : bytes < 1e9 ? `${(bytes / 1e6).toFixed(bytes < 1e7 ? 1 : 0)} MB` : `${(bytes / 1e9).toFixed(1)} GB`;
}

/** Where the playhead is. It goes on by the page's clock, unless the sound says where it is. */
export class Playhead {
  isPlaying = false;
  speed = 1;
  private time = 0;
  private since = 0;

  /** `now` is in seconds, of the page. */
  at(now: number): number {
    return this.isPlaying ? this.time + (now - this.since) * this.speed : this.time;
  }

  go(time: number, now: number): void {
    this.time = time;
    this.since = now;
  }

  play(isPlaying: boolean, now: number): void {
    this.go(this.at(now), now);
    this.isPlaying = isPlaying;
  }

  setSpeed(speed: number, now: number): void {
    this.go(this.at(now), now);
    this.speed = speed;
  }
}

/** Fetches one thing at a time. What is wanted meanwhile replaces what waits. */
export class Latest<T> {
  private wanted: T | null = null;
  private isBusy = false;

  constructor(private readonly fetch: (item: T) => Promise<void>) {}

  want(item: T): void {
    this.wanted = item;
    if (!this.isBusy) void this.work();
  }

  private async work(): Promise<void> {
    this.isBusy = true;
    while (this.wanted !== null) {
      const item = this.wanted;
      this.wanted = null;
      await this.fetch(item).catch(() => undefined);
    }
    this.isBusy = false;
  }
}
