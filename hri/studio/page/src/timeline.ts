// A recording from its beginning to its end: rows of marks, the curves of the mood, the playhead.

import uPlot from "uplot";
import { element } from "./dom";
import { ROWS, clock, moodAt, type Mark, type Mood, type Recording, type Row } from "./recording";

const NAMES = ["pleasure", "arousal", "dominance"] as const;
const HEIGHT = 120;
/** Pixels by which the canvas goes beyond the lanes on both sides, for the words of the axis. */
const ASIDE = 15;
/** Marks closer than this part of the timeline are one. */
const FINEST = 1 / 2000;

export class Timeline {
  private start = 0;
  private end = 1;
  private readonly curves: uPlot;
  private readonly lanes = new Map<Row, SVGElement>();
  private readonly values = new Map<(typeof NAMES)[number], HTMLElement>();

  constructor(private readonly tracks: HTMLElement, go: (time: number) => void) {
    const curves = element("rec-curves");
    for (const [row, name] of Object.entries(ROWS)) this.addLane(row as Row, name, curves);
    for (const name of NAMES) this.addValue(name);
    this.curves = plot(curves, () => [this.start, this.end]);
    new ResizeObserver(() => this.fit()).observe(curves);
    matchMedia("(prefers-color-scheme: dark)").addEventListener("change", () => this.curves.redraw());
    this.letDrag(go);
  }

  draw(recording: Recording): void {
    this.start = recording.about.start;
    this.end = Math.max(recording.about.end, this.start + 0.1);
    for (const [row, lane] of this.lanes)
      lane.replaceChildren(...apart(recording.marks.filter((one) => one.row === row), FINEST * (this.end - this.start)).map((one) => this.mark(one)));
    const moods = held(recording.moods, this.start, this.end);
    this.curves.setData([moods.map((one) => one.time), ...NAMES.map((name) => moods.map((one) => one[name]))] as uPlot.AlignedData);
    this.fit();
  }

  show(recording: Recording, time: number): void {
    this.tracks.style.setProperty("--at", String(this.part(time)));
    const mood = moodAt(recording, time);
    for (const [name, value] of this.values) value.textContent = mood === null ? "" : mood[name].toFixed(2);
  }

  private fit(): void {
    const width = element("rec-curves").clientWidth;
    if (width > 0 && width !== this.curves.width) this.curves.setSize({ width, height: HEIGHT });
  }

  private edge(): DOMRect {
    return this.lanes.get("heard")!.getBoundingClientRect();
  }

  private part(time: number): number {
    return Math.min(1, Math.max(0, (time - this.start) / (this.end - this.start)));
  }

  private mark(mark: Mark): SVGElement {
    const made = document.createElementNS("http://www.w3.org/2000/svg", "line");
    for (const [key, part] of [["x1", this.part(mark.from)], ["x2", this.part(mark.to)]] as const) made.setAttribute(key, `${(100 * part).toFixed(3)}%`);
    made.setAttribute("y1", "50%");
    made.setAttribute("y2", "50%");
    made.setAttribute("class", mark.kind);
    const title = document.createElementNS("http://www.w3.org/2000/svg", "title");
    title.textContent = `${clock(mark.from)} ${mark.about}`;
    made.append(title);
    return made;
  }

  private addLane(row: Row, name: string, before: HTMLElement): void {
    const label = document.createElement("span");
    label.className = "lane-name";
    label.textContent = name;
    const lane = document.createElementNS("http://www.w3.org/2000/svg", "svg");
    lane.setAttribute("class", "lane");
    lane.setAttribute("aria-hidden", "true");
    before.previousElementSibling!.before(label, lane);
    this.lanes.set(row, lane);
  }

  private addValue(name: (typeof NAMES)[number]): void {
    const row = document.createElement("span");
    row.className = name;
    const value = document.createElement("b");
    row.append(name, " ", value);
    element("rec-values").append(row);
    this.values.set(name, value);
  }

  /** Drag anywhere on the tracks; the slider above them drags by itself. */
  private letDrag(go: (time: number) => void): void {
    const tracks = this.tracks;
    const drag = (event: PointerEvent) => {
      const edge = this.edge();
      const part = Math.min(1, Math.max(0, (event.clientX - edge.left) / edge.width));
      go(this.start + part * (this.end - this.start));
    };
    tracks.addEventListener("pointerdown", (event) => {
      if (event.button !== 0 || event.target instanceof HTMLInputElement || event.clientX < this.edge().left) return;
      tracks.setPointerCapture(event.pointerId);
      drag(event);
    });
    tracks.addEventListener("pointermove", (event) => {
      if (tracks.hasPointerCapture(event.pointerId)) drag(event);
    });
  }
}

/** The moods from the beginning to the end: the last one holds. */
function held(moods: readonly Mood[], start: number, end: number): Mood[] {
  const first = moods[0];
  const last = moods.at(-1);
  if (first === undefined || last === undefined) return [];
  return [{ ...first, time: Math.min(start, first.time) }, ...moods, { ...last, time: Math.max(end, last.time) }];
}

/** Marks, without those that would be drawn over the one before. */
function apart(marks: readonly Mark[], least: number): Mark[] {
  const kept: Mark[] = [];
  for (const mark of marks) {
    const before = kept.at(-1);
    if (before === undefined || before.kind !== mark.kind || mark.to - before.to >= least || mark.from < before.from) kept.push(mark);
  }
  return kept;
}

function plot(parent: HTMLElement, range: () => [number, number]): uPlot {
  const color = (name: string) => () => getComputedStyle(document.documentElement).getPropertyValue(name).trim();
  const grid = { stroke: color("--line"), width: 1 };
  return new uPlot(
    {
      width: 300,
      height: HEIGHT,
      padding: [6, ASIDE, 0, ASIDE],
      cursor: { show: false },
      legend: { show: false },
      scales: { x: { time: false, range }, y: { range: [-1, 1] } },
      axes: [
        { stroke: color("--quiet"), grid, ticks: { show: false }, font: "11px system-ui", size: 22, space: 70, incrs: [1, 2, 5, 10, 15, 30, 60, 120, 300, 600, 900, 1800, 3600, 7200, 14400, 86400, 604800], values: (_, times) => times.map((time) => clock(time)) },
        { grid, ticks: { show: false }, size: 0, splits: () => [-1, 0, 1], values: () => [] },
      ],
      series: [{}, ...NAMES.map((label) => ({ label, stroke: color(`--${label}`), width: 2, points: { show: false } }))],
    },
    [[], [], [], []],
    parent,
  );
}
