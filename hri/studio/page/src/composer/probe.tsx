// The value of one port: a curve while it is pointed at, and where it comes from.

import type { ComposerDocument } from "./document";
import { inWords, type LiveValues } from "./live_values";
import { useStore } from "./store";

const WIDTH = 180;
const HEIGHT = 48;

export interface Pointed {
  port: string;
  x: number;
  y: number;
}

/** Beside the pointer: the value of an output, with its last ten seconds. */
export function Probe({ doc, live, pointed }: { doc: ComposerDocument; live: LiveValues; pointed: Pointed }) {
  useStore(live.count);
  const ports = sourcesOf(doc, pointed.port);
  return (
    <div className="probe" style={{ left: pointed.x + 14, top: pointed.y + 14 }} role="tooltip">
      {ports.map((port) => (
        <div key={port}>
          <b>{port}</b> {inWords(live.sample?.values[port])}
          <Curve points={live.curve(port)} />
        </div>
      ))}
      {ports.length === 0 ? <span>{pointed.port}: nothing reaches it</span> : null}
    </div>
  );
}

/** An output itself; of an input those that are linked to it. */
function sourcesOf(doc: ComposerDocument, port: string): string[] {
  const sources = doc.network.links.filter((one) => one.to === port).map((one) => one.from);
  return sources.length > 0 ? sources : doc.network.links.some((one) => one.from === port) || !isInput(doc, port) ? [port] : [];
}

function isInput(doc: ComposerDocument, port: string): boolean {
  const [id, name] = port.split(".");
  const type = doc.network.behaviors.find((one) => one.id === id)?.type;
  return doc.palette.value.behaviors.find((one) => one.type === type)?.inputs.some((one) => one.name === name) ?? false;
}

export function Curve({ points }: { points: readonly number[] }) {
  if (points.length < 2) return null;
  const low = Math.min(...points);
  const high = Math.max(...points);
  const height = (value: number) => HEIGHT - 3 - (high > low ? (value - low) / (high - low) : 0.5) * (HEIGHT - 6);
  const path = points.map((value, number) => `${((number / (points.length - 1)) * WIDTH).toFixed(1)},${height(value).toFixed(1)}`).join(" ");
  return (
    <svg viewBox={`0 0 ${WIDTH} ${HEIGHT}`} width={WIDTH} height={HEIGHT} role="img" aria-label={`from ${inWords(low)} to ${inWords(high)}`}>
      <polyline points={path} fill="none" stroke="var(--accent)" strokeWidth="1.5" />
      <text x="2" y="11">{inWords(high)}</text>
      <text x="2" y={HEIGHT - 2}>{inWords(low)}</text>
    </svg>
  );
}

/** "Why is this 0?": the way back from a port to what decided. */
export function Why({ doc, live, port, close }: { doc: ComposerDocument; live: LiveValues; port: string; close(): void }) {
  const steps = useStore(live.reasons)[`${live.name}/${port}`] ?? [];
  useStore(live.count);
  return (
    <section className="why" aria-label={`Why ${port} is what it is`}>
      <h2>Why is {port} {inWords(live.sample?.values[port])}?</h2>
      <ol>
        {steps.map((step, number) => (
          <li key={number}>
            <button type="button" onClick={() => doc.select([step.port.startsWith("board.") ? step.port : step.port.split(".")[0]!])}>{step.port}</button> <b>{inWords(step.value)}</b>
            <br />{step.words}
          </li>
        ))}
      </ol>
      <button type="button" onClick={close}>Close</button>
    </section>
  );
}
