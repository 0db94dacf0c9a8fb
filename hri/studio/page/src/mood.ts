// The mood of the last minutes as three curves, and what its causes were.

import uPlot from "uplot";
import { ago, type Moods } from "./state";
import { list } from "./dom";

const HEIGHT = 120;
const MOST_REASONS = 6;
const NAMES = ["pleasure", "arousal", "dominance"] as const;

export class MoodCurve {
  private readonly plot: uPlot;

  constructor(
    private readonly parent: HTMLElement,
    private readonly reasons: HTMLElement,
  ) {
    const style = getComputedStyle(document.documentElement);
    const color = (name: string) => style.getPropertyValue(name).trim();
    const axis = { stroke: color("--quiet"), grid: { stroke: color("--line"), width: 1 }, font: "11px system-ui" };
    this.plot = new uPlot(
      {
        width: 300,
        height: HEIGHT,
        cursor: { show: false },
        scales: { x: { time: false }, y: { range: [-1, 1] } },
        axes: [{ ...axis, size: 24, values: (_, ticks) => ticks.map((tick) => `${tick} s`) }, { ...axis, size: 30 }],
        series: [{}, ...NAMES.map((label) => ({ label, stroke: color(`--${label}`), width: 2, points: { show: false } }))],
        legend: { live: false },
      },
      [[], [], [], []],
      parent,
    );
  }

  draw(moods: Moods | undefined): void {
    const points = moods?.points ?? [];
    const last = points.at(-1)?.[0] ?? 0;
    const width = Math.max(160, this.parent.clientWidth);
    if (width !== this.plot.width) this.plot.setSize({ width, height: HEIGHT });
    this.plot.setData([points.map((one) => one[0]! - last), ...NAMES.map((_, part) => points.map((one) => one[part + 1]!))] as uPlot.AlignedData);
    const reasons = (moods?.reasons ?? []).slice(-MOST_REASONS).reverse();
    list(this.reasons, reasons, (one) => ({ text: one.why, detail: ago(last - one.t), kind: "" }));
  }
}
