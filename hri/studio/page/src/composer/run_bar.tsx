// Runs the network that is open: start, stop, pause, one tick.

import type { ComposerDocument } from "./document";
import type { LiveValues, RunningNetwork } from "./live_values";
import { useStore } from "./store";

/** Whether it was done; the reason of a refusal is in the notice. */
export type Ask = (command: string, given: Record<string, unknown>) => Promise<boolean>;

interface RunBarProps {
  doc: ComposerDocument;
  live: LiveValues;
  running: RunningNetwork | undefined;
  ask: Ask;
  breakAt(port: string): void;
}

export function RunBar({ doc, live, running, ask, breakAt }: RunBarProps) {
  useStore(doc.revision);
  const problems = useStore(doc.problems);
  const path = useStore(doc.path);
  const others = useStore(live.networks).filter((one) => one.is_own && one.path !== path);
  const isWrong = problems.some((one) => one.grave === "error");
  const start = () => ask("network_start", { path, ...(doc.history.isDirty ? { text: doc.history.text } : {}) });
  const name = running?.name ?? "";
  return (
    <div className="run-bar" role="toolbar" aria-label="Run">
      {running ? (
        <>
          <span className={running.is_paused ? "badge paused" : "badge running"}>{running.is_paused ? "paused" : "runs"}</span>
          <button type="button" aria-pressed={running.is_paused} onClick={() => void ask("network_pause", { name, on: !running.is_paused })}>Pause</button>
          <button type="button" disabled={!running.is_paused} onClick={() => void ask("network_tick", { name })}>One tick</button>
          {running.is_own ? (
            <>
              <button type="button" disabled={isWrong} title="run it as it is here now" onClick={() => void start()}>Start again</button>
              <button type="button" onClick={() => void ask("network_stop", { name })}>End</button>
            </>
          ) : null}
          <span className="quiet">{Math.round(1 / running.interval)} Hz, {running.ticks} ticks, {running.missed} missed</span>
          {running.breakpoint ? <button type="button" onClick={() => breakAt(running.breakpoint!.port)}>Break: {running.breakpoint.port} {running.breakpoint.condition}</button> : null}
          {running.hit ? <strong className="hit">{running.hit}</strong> : null}
        </>
      ) : (
        <>
          <button type="button" disabled={isWrong || path === ""} onClick={() => void start()}>Start</button>
          <span className="quiet">{isWrong ? "it has errors" : "it does not run"}</span>
        </>
      )}
      {others.map((one) => <span key={one.name} className="quiet">{one.name} runs <button type="button" onClick={() => void ask("network_stop", { name: one.name })}>End {one.name}</button></span>)}
    </div>
  );
}
