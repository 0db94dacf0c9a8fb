// "Why is this 0?": the way back from a port, through the wires, to what decided.

import type { Network } from "./network";
import { behaviorKind, portsOf, type Palette } from "./wiring";

export interface Step {
  /** An output: `behavior.port`, or a slot of the board. */
  port: string;
  value: unknown;
  text: string;
}

const MOST_STEPS = 40;

type Values = Record<string, unknown>;
interface Sent {
  port: string;
  value: unknown;
}

/** Which of the inputs decided what a behavior sends, by type; where it is unknown, all of them. */
const DECIDERS: Record<string, (sent: Sent[], value: unknown) => [Sent[], string]> = {
  "Hri.Minimum": extreme("the least of its inputs"),
  "Hri.Maximum": extreme("the greatest of its inputs"),
  "Hri.And": logic(false, "one of its inputs is false", "all of its inputs are true"),
  "Hri.Or": logic(true, "one of its inputs is true", "all of its inputs are false"),
  "Hri.PriorityArbiter": (sent) => {
    const first = sent.find((one) => one.value !== null && one.value !== undefined);
    return [first ? [first] : sent, first ? "the first of its inputs that was sent" : "none of its inputs was sent"];
  },
};

function extreme(words: string): (sent: Sent[], value: unknown) => [Sent[], string] {
  return (sent, value) => {
    const deciding = sent.filter((one) => one.value === value);
    return [deciding.length > 0 ? deciding : sent, words];
  };
}

function logic(decides: boolean, one: string, all: string): (sent: Sent[], value: unknown) => [Sent[], string] {
  return (sent) => {
    const deciding = sent.filter((input) => Boolean(input.value) === decides);
    return deciding.length > 0 ? [deciding, one] : [sent, all];
  };
}

/** From an output or an input, nearest first. `values` are those of outputs and slots. */
export function why(n: Network, palette: Palette, values: Values, port: string, resting: readonly string[] = []): Step[] {
  const steps: Step[] = [];
  const seen = new Set<string>();
  const sources = n.links.filter((one) => one.to === port).map((one) => one.from);
  const isInput = sources.length > 0 || isInputOf(n, palette, port);
  if (isInput && !port.startsWith("board.") && sources.length === 0) return [{ port, value: null, text: `nothing was sent: nothing reaches ${port}` }];
  const waiting = isInput && !port.startsWith("board.") ? [...sources] : [port];
  while (waiting.length > 0 && steps.length < MOST_STEPS) {
    const next = waiting.shift()!;
    if (seen.has(next)) continue;
    seen.add(next);
    const [text, before] = explained(n, palette, values, next, resting);
    steps.push({ port: next, value: values[next] ?? null, text });
    waiting.push(...before);
  }
  return steps;
}

function isInputOf(n: Network, palette: Palette, port: string): boolean {
  const [id = "", name] = port.split(".");
  const { inputs, outputs } = portsOf(n, palette, id);
  return inputs.some((one) => one.name === name) && !outputs.some((one) => one.name === name);
}

/** Why an output is what it is, and the outputs that decided. */
function explained(n: Network, palette: Palette, values: Values, port: string, resting: readonly string[]): [string, string[]] {
  if (port.startsWith("board.")) {
    const writers = n.links.filter((one) => one.to === port).map((one) => one.from);
    return writers.length > 0 ? [`written by ${writers.join(", ")}`, writers] : ["read from the board: another network or a task writes it", []];
  }
  const [id = ""] = port.split(".");
  const behavior = n.behaviors.find((one) => one.id === id);
  if (behavior === undefined) return [`there is no behavior "${id}"`, []];
  if (resting.includes(id)) return [`${id} rests after an error - the log says which`, []];
  const kind = behaviorKind(palette, behavior.type);
  const inputs = n.links.filter((one) => one.to.split(".")[0] === id);
  const sent = inputs.map((one) => ({ port: one.from, value: values[one.from] }));
  if (inputs.length === 0) {
    const set = [...behavior.parameters].map(([name, value]) => `${name} = ${value}`).join(", ");
    if (kind?.is_sensor) return [`${behavior.type} senses it${values[port] == null ? ": its device sends nothing now" : ""}`, []];
    const needs = kind?.inputs.filter((one) => !one.is_optional) ?? [];
    if (needs.length > 0) return [`nothing was sent: nothing reaches ${needs.map((one) => `${id}.${one.name}`).join(", ")}`, []];
    return [`${behavior.type} makes it${set ? `: ${set}` : ""}`, []];
  }
  const isEmpty = sent.every((one) => one.value === null || one.value === undefined);
  if (isEmpty) return [`nothing reached ${id} in this tick`, sent.map((one) => one.port)];
  const [deciding, words] = DECIDERS[kind?.type ?? ""]?.(sent, values[port]) ?? [sent, `${behavior.type} makes it of its inputs`];
  return [words, deciding.map((one) => one.port)];
}
