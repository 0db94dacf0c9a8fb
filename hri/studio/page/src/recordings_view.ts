// The view of recordings: the list of those that are known, and one that is open.

import { element, type Row } from "./dom";
import { Player, addressOf } from "./player";
import { begun, clock, feelingAt, size, spoken, takePart, type About, type Listed, type Part, type Recording } from "./recording";
import { hashOf } from "./views";
import { Rows } from "./rows";
import { summary } from "./state";
import { Timeline } from "./timeline";

const SPEEDS = [0.5, 1, 2];
/** Milliseconds between two looks at a recording that grows. */
const AGAIN = 2000;

/** Letters of a row that are shown. */
const LONGEST = 500;

/** The keys while a recording is open. */
export const KEYS: [string, string][] = [
  ["Space", "play, pause"],
  ["← →", "a second back, on"],
  ["Shift ← →", "ten seconds back, on"],
  ["Home, End", "to the beginning, the end"],
];

export class RecordingsView {
  private recording: Recording | null = null;
  private isOn = false;
  /** Counts what was asked to be shown: an answer to an older question is left out. */
  private asked = 0;
  private second = -1;
  private readonly player = new Player((time) => this.showTime(time), (words) => say(words));
  private readonly timeline = new Timeline(element("rec-tracks"), (time) => this.player.go(time));
  private readonly lines = new Rows(element("rec-lines"), (time) => this.player.go(time));
  private readonly events = new Rows(element("rec-events"), (time) => this.player.go(time));
  private readonly slider = element<HTMLInputElement>("rec-slider");

  constructor() {
    this.slider.addEventListener("input", () => this.player.go(Number(this.slider.value)));
    element("rec-play").addEventListener("click", () => this.toggle());
    element("rec-mute").addEventListener("click", (event) => {
      const button = event.currentTarget as HTMLElement;
      const isOn = button.getAttribute("aria-pressed") !== "true";
      button.setAttribute("aria-pressed", String(isOn));
      this.player.setMuted(!isOn);
    });
    for (const speed of SPEEDS) this.addSpeed(speed);
    element("rec-open").addEventListener("submit", (event) => {
      event.preventDefault();
      const folder = element<HTMLInputElement>("rec-folder").value.trim();
      if (folder) location.hash = hashOf("recordings", folder);
    });
    document.addEventListener("keydown", (event) => this.press(event));
    element("rec-one").addEventListener("click", (event) => {
      // The space bar stays with the player: a click does not say where the keyboard is wanted.
      if ((event as PointerEvent).pointerType === "mouse") (event.target as Element).closest<HTMLElement>("button")?.blur();
    });
  }

  /** Show a recording, or for an empty name the list. */
  async show(folder: string): Promise<void> {
    this.close();
    this.isOn = true;
    say("");
    element<HTMLInputElement>("rec-folder").value = folder;
    const { asked } = this;
    try {
      if (!folder) return await this.list();
      const about = await get<About>(addressOf("about", { folder }));
      if (asked === this.asked) await this.open(begun(about));
    } catch (error) {
      if (asked !== this.asked) return;
      if (folder) await this.list().catch(() => undefined);
      if (asked === this.asked) say(why(error));
    }
  }

  close(): void {
    this.asked++;
    this.isOn = false;
    this.recording = null;
    this.player.open(null);
  }

  private async list(): Promise<void> {
    document.title = "Recordings - hri studio";
    element("rec-list").hidden = false;
    element("rec-one").hidden = true;
    const { recordings } = await get<{ recordings: Listed[] }>("/api/v1/recordings");
    element("rec-none").hidden = recordings.length > 0;
    element("rec-known").replaceChildren(...recordings.map(link));
  }

  private async open(recording: Recording): Promise<void> {
    const { about } = recording;
    this.recording = recording;
    document.title = `${about.name} - hri studio`;
    element("rec-list").hidden = true;
    element("rec-one").hidden = false;
    element("rec-title").textContent = about.name;
    element("rec-title").focus();
    this.lines.clear();
    this.events.clear();
    this.second = -1;
    this.draw(recording);
    this.player.open(about);
    await this.follow(recording);
  }

  /** Read the log, and again as long as it grows; where that fails, what is there stays. */
  private async follow(recording: Recording): Promise<void> {
    for (let from = 0; this.recording === recording; ) {
      try {
        from = await this.read(recording, from);
        if (!recording.about.is_growing || recording.isCut) return;
        await new Promise((over) => setTimeout(over, AGAIN));
        const about = await get<About>(addressOf("about", recording.about));
        if (this.recording !== recording) return;
        recording.about = about;
        this.player.take(about);
        this.draw(recording);
        say("");
      } catch (error) {
        if (this.recording !== recording) return;
        say(why(error));
        if (!(error instanceof TypeError)) return;
        await new Promise((over) => setTimeout(over, AGAIN));
      }
    }
  }

  /** Read the log from a byte on, part by part; the byte up to which it is read. */
  private async read(recording: Recording, from: number): Promise<number> {
    for (let isAll = false; !isAll && !recording.isCut; ) {
      const part = await get<Part>(`${addressOf("events", recording.about)}&from=${from}`);
      if (this.recording !== recording) break;
      [from, isAll] = [part.next, part.is_all];
      this.take(recording, part);
    }
    return from;
  }

  private take(recording: Recording, part: Part): void {
    const [lines, events] = [recording.lines.length, recording.events.length];
    takePart(recording, part);
    this.lines.add(recording.lines.slice(lines).map((line) => ({ text: line.text.slice(0, LONGEST), detail: line.detail, kind: line.who, time: line.time })));
    this.events.add(recording.events.slice(events).map((event): Row & { time: number } => ({ text: event.event, detail: summary(event).slice(0, LONGEST), kind: "", time: event.t })));
    this.draw(recording);
    this.showTime(this.player.time);
  }

  /** What does not move with the playhead. */
  private draw(recording: Recording): void {
    const { about, skipped, isCut } = recording;
    element("rec-facts").textContent = [date(about), clock(about.end - about.start), size(about.bytes)].join(" · ");
    element("rec-growing").hidden = !about.is_growing;
    const notes = [...about.wrong];
    if (skipped) notes.push(`${skipped} line${skipped === 1 ? "" : "s"} of the log could not be read`);
    if (isCut) notes.push("the log is longer than this page can show");
    element("rec-wrong").textContent = notes.join(". ");
    element("rec-face").classList.toggle("missing", about.face === null);
    element("rec-mute").hidden = about.sound === null;
    element("rec-silent").hidden = recording.lines.length > 0;
    this.slider.min = String(about.start);
    this.slider.max = String(about.end);
    element("rec-end").textContent = clock(about.end);
    this.timeline.draw(recording);
  }

  private showTime(time: number): void {
    const { recording } = this;
    element("rec-play").textContent = this.player.isPlaying ? "Pause" : "Play";
    element("rec-play").classList.toggle("playing", this.player.isPlaying);
    if (recording === null) return;
    this.timeline.show(recording, time);
    this.slider.value = String(time);
    element("rec-now").textContent = clock(time, 1);
    if (Math.floor(time) !== this.second) {
      this.second = Math.floor(time);
      this.slider.setAttribute("aria-valuetext", `${spoken(time)} of ${spoken(recording.about.end)}`);
    }
    const feeling = feelingAt(recording, time);
    const words = feeling && `I am ${feeling}`;
    if (element("rec-felt").textContent !== words) element("rec-felt").textContent = words;
    this.lines.show(time);
    this.events.show(time);
  }

  private toggle(): void {
    this.player.play(!this.player.isPlaying);
  }

  private press(event: KeyboardEvent): void {
    const { recording } = this;
    if (!this.isOn || recording === null || event.ctrlKey || event.metaKey || event.altKey) return;
    if (document.querySelector("dialog[open]")) return;
    const target = event.target as Element;
    const isSlider = target === this.slider;
    if (target instanceof HTMLInputElement && !isSlider) return;
    const step = event.shiftKey ? 10 : 1;
    const keys: Record<string, () => void> = {
      ArrowLeft: () => this.player.go(this.player.time - step),
      ArrowRight: () => this.player.go(this.player.time + step),
      Home: () => this.player.go(recording.about.start),
      End: () => this.player.go(recording.about.end),
    };
    // A button that has the focus takes the space bar itself.
    if (target.closest("button, a") === null) keys[" "] = () => event.repeat || this.toggle();
    const act = keys[event.key];
    if (act === undefined) return;
    event.preventDefault();
    act();
  }

  private addSpeed(speed: number): void {
    const button = document.createElement("button");
    button.type = "button";
    button.textContent = `${speed}×`;
    button.setAttribute("aria-pressed", String(speed === 1));
    button.addEventListener("click", () => {
      this.player.setSpeed(speed);
      for (const one of element("rec-speeds").children) one.setAttribute("aria-pressed", String(one === button));
    });
    element("rec-speeds").append(button);
  }
}

async function get<T>(address: string): Promise<T> {
  const response = await fetch(address);
  const answer = (await response.json()) as T & { error?: string };
  if (!response.ok) throw new Error(answer.error);
  return answer;
}

function why(error: unknown): string {
  return error instanceof TypeError ? "no link to the robot" : (error as Error).message;
}

function say(words: string): void {
  const notice = element("rec-notice");
  notice.textContent = words;
  notice.hidden = words === "";
}

function date(listed: Listed): string {
  return new Date(listed.written * 1000).toLocaleString(undefined, { dateStyle: "medium", timeStyle: "short" });
}

function link(listed: Listed): HTMLElement {
  const row = document.createElement("li");
  const made = document.createElement("a");
  made.href = hashOf("recordings", listed.folder);
  const parts: [string, string][] = [
    ["name", listed.name],
    ["date", date(listed)],
    ["length", clock(listed.length)],
    ["size", size(listed.bytes)],
    ["folder", listed.folder],
  ];
  if (listed.is_growing) parts.push(["growing", "being recorded"]);
  for (const [kind, text] of parts) {
    const part = document.createElement("span");
    part.className = kind;
    part.textContent = text;
    made.append(part, " ");
  }
  row.append(made);
  return row;
}
