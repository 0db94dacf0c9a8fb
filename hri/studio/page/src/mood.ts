// The mood of the last minutes as three curves.

import uPlot from "uplot";
import type { Mood } from "./state";

const HEIGHT = 120;
const NAMES = ["pleasure", "arousal", "dominance"] as const;

export class MoodCurve {
  private readonly plot: uPlot;

  constructor(private readonly parent: HTMLElement) {
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

  draw(moods: readonly Mood[]): void {
    const last = moods.at(-1)?.time ?? 0;
    const width = Math.max(160, this.parent.clientWidth);
    if (width !== this.plot.width) this.plot.setSize({ width, height: HEIGHT });
    this.plot.setData([moods.map((one) => one.time - last), ...NAMES.map((name) => moods.map((one) => one[name]))] as uPlot.AlignedData);
  }
}
