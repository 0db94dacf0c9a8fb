// "Why is this 0?": the way back from a port, through the wires, to what decided.

import { isSlot, ownerOf, type Network } from "./network";
import { behaviorKind, portsOf, type BehaviorType, type Palette } from "./wiring";

export interface Step {
  /** An output: `behavior.port`, or a slot of the board. */
  port: string;
  value: unknown;
  text: string;
}

const MOST_STEPS = 40;

type Values = Record<string, unknown>;

/** What a link brings to a behavior. */
interface Taken {
  port: string;
  value: unknown;
  input: string;
}

/** In words why a value is what it is, and what decided it. */
type Reason = [string, Taken[]];

/** By type, who decides; null where all of the inputs do. */
type Decider = (taken: Taken[], value: unknown) => Reason | null;

const DECIDERS: Record<string, Decider> = {
  "Hri.Minimum": extreme("the least of its inputs"),
  "Hri.Maximum": extreme("the greatest of its inputs"),
  "Hri.And": logic(false, "one of its inputs is false"),
  "Hri.Or": logic(true, "one of its inputs is true"),
  "Hri.PriorityArbiter": (taken) => {
    const first = taken.find(isSent);
    return first ? ["the first of its inputs that sent something wins", [first]] : null;
  },
  "Hri.Inhibit": (taken, value) => {
    const holding = to(taken, "inhibitor").filter((one) => isSent(one) && one.value !== false);
    if (holding.length > 0) return ["it is held back by its inhibitor", [...holding, ...to(taken, "replacement")]];
    const wished = to(taken, "input");
    return isEmpty(value) && wished.some(isSent) ? ["it is held back still, for hold_s after its inhibitor ended", []] : ["nothing holds it back", wished];
  },
  "Hri.Select": (taken) => {
    const [choice] = to(taken, "choice").filter(isSent);
    if (!choice) return ["nothing is chosen without a choice", to(taken, "choice")];
    return [`the choice is ${String(choice.value)}`, [choice, ...to(taken, choice.value ? "when_true" : "when_false")]];
  },
  "Hri.Division": (taken) => {
    const zero = to(taken, "divisor").filter((one) => one.value === 0);
    return zero.length > 0 ? ["nothing can be divided by 0", zero] : null;
  },
};

function to(taken: Taken[], input: string): Taken[] {
  return taken.filter((one) => one.input === input);
}

function isEmpty(value: unknown): boolean {
  return value === null || value === undefined;
}

function isSent(one: Taken): boolean {
  return !isEmpty(one.value);
}

function extreme(words: string): Decider {
  return (taken, value) => {
    const deciding = taken.filter((one) => isSent(one) && one.value === value);
    return deciding.length > 0 ? [words, deciding] : null;
  };
}

function logic(decides: boolean, words: string): Decider {
  return (taken) => {
    const deciding = taken.filter((one) => one.value === decides);
    return deciding.length > 0 ? [words, deciding] : null;
  };
}

/**
 * From an output or an input, nearest first. `values` are those of outputs and slots; `resting` are
 * the ids of behaviors that rest after an error.
 */
export function why(n: Network, palette: Palette, values: Values, port: string, resting: readonly string[] = []): Step[] {
  const steps: Step[] = [];
  const seen = new Set<string>();
  const isInput = isInputOf(n, palette, port);
  const sources = linked(n, port);
  if (isInput && sources.length === 0) return [{ port, value: null, text: `nothing was sent: nothing reaches ${port}` }];
  const waiting = isInput ? sources : [port];
  for (let next = waiting.shift(); next !== undefined && steps.length < MOST_STEPS; next = waiting.shift()) {
    if (seen.has(next)) continue;
    seen.add(next);
    const [text, before] = explained(n, palette, values, next, resting);
    steps.push({ port: next, value: values[next] ?? null, text });
    waiting.push(...before);
  }
  return steps;
}

/** The outputs that links lead from to an input, or to a slot. */
function linked(n: Network, port: string): string[] {
  return n.links.filter((one) => one.to === port).map((one) => one.from);
}

/** Where a behavior has an input and an output of one name, the output is meant. */
function isInputOf(n: Network, palette: Palette, port: string): boolean {
  if (isSlot(port)) return false;
  const { inputs, outputs } = portsOf(n, palette, ownerOf(port));
  const isThere = (ports: { name: string }[]) => ports.some((one) => `${ownerOf(port)}.${one.name}` === port);
  return isThere(inputs) && !isThere(outputs);
}

/** Why an output is what it is, and the outputs that decided. */
function explained(n: Network, palette: Palette, values: Values, port: string, resting: readonly string[]): [string, string[]] {
  if (isSlot(port)) {
    const writers = linked(n, port);
    return writers.length > 0 ? [`written by ${writers.join(", ")}`, writers] : ["read from the board: another network or a task writes it", []];
  }
  const id = ownerOf(port);
  const behavior = n.behaviors.find((one) => one.id === id);
  if (behavior === undefined) return [`there is no behavior "${id}"`, []];
  if (resting.includes(id)) return [`${id} rests after an error - the log says which`, []];
  const kind = behaviorKind(palette, behavior.type);
  const taken = n.links.filter((one) => ownerOf(one.to) === id).map((one) => ({ port: one.from, value: values[one.from], input: one.to.slice(id.length + 1) }));
  const [text, deciding] = taken.length === 0 ? alone(behavior, kind, values[port]) : decided(id, behavior.type, kind, taken, values[port]);
  return [text, [...new Set(deciding.map((one) => one.port))]];
}

/** Of a behavior that no link reaches. */
function alone({ id, type, parameters }: { id: string; type: string; parameters: ReadonlyMap<string, string> }, kind: BehaviorType | undefined, value: unknown): Reason {
  if (kind?.is_sensor) return [`${type} senses it${isEmpty(value) ? ": its device sends nothing now" : ""}`, []];
  const needs = kind?.inputs.filter((one) => !one.is_optional) ?? [];
  if (isEmpty(value) && needs.length > 0) return [`nothing was sent: nothing reaches ${needs.map((one) => `${id}.${one.name}`).join(", ")}`, []];
  const set = [...parameters].map(([name, text]) => `${name} = ${text}`).join(", ");
  return [`${type} makes it${set ? `: ${set}` : ""}`, []];
}

/** Of a behavior that links reach. */
function decided(id: string, type: string, kind: BehaviorType | undefined, taken: Taken[], value: unknown): Reason {
  if (isEmpty(value) && !taken.some(isSent)) return [`nothing was sent: nothing came to ${id} in this tick`, taken];
  const decider = DECIDERS[kind?.type ?? type]?.(taken, value);
  if (decider) return decider;
  if (!isEmpty(value)) return [`${type} makes it of its inputs`, taken.some(isSent) ? taken.filter(isSent) : taken];
  const missing = (kind?.inputs ?? []).filter((one) => !one.is_optional && !to(taken, one.name).some(isSent));
  if (missing.length === 0) return [`${type} sends nothing for what came`, taken];
  const silent = missing.flatMap((one) => to(taken, one.name));
  const words = missing.map((one) => `${to(taken, one.name).length > 0 ? "nothing came to" : "nothing reaches"} ${id}.${one.name}`);
  return [`nothing was sent: ${words.join(", ")}`, silent.length > 0 ? silent : taken];
}
