// How two networks differ, for a person who has to choose one.

import type { Behavior, Network } from "./network";

export interface Difference {
  added: string[];
  removed: string[];
  changed: { id: string; what: string[] }[];
  links: { added: string[]; removed: string[] };
  attributes: string[];
  /** Byte by byte; where nothing above differs and this is false: places, order, comments, spaces. */
  isSame: boolean;
}

export function compare(old: Network, next: Network): Difference {
  const [before, after] = [old, next].map((one) => new Map(one.behaviors.map((behavior) => [behavior.id, behavior]))) as [Map<string, Behavior>, Map<string, Behavior>];
  const [linksBefore, linksAfter] = [old, next].map((one) => new Set(one.links.map(({ from, to }) => `${from} -> ${to}`))) as [Set<string>, Set<string>];
  return {
    added: [...after.keys()].filter((id) => !before.has(id)),
    removed: [...before.keys()].filter((id) => !after.has(id)),
    changed: [...after].flatMap(([id, behavior]) => {
      const what = before.has(id) ? changesOf(before.get(id)!, behavior) : [];
      return what.length > 0 ? [{ id, what }] : [];
    }),
    links: {
      added: [...linksAfter].filter((one) => !linksBefore.has(one)),
      removed: [...linksBefore].filter((one) => !linksAfter.has(one)),
    },
    attributes: [change("name", old.name, next.name), change("interval", old.interval, next.interval)].filter((one) => one !== ""),
    isSame: old.text === next.text,
  };
}

function changesOf(before: Behavior, after: Behavior): string[] {
  const names = new Set([...before.parameters.keys(), ...after.parameters.keys()]);
  const parameters = [...names].map((name) => change(name, before.parameters.get(name), after.parameters.get(name)));
  return [change("type", before.type, after.type), ...parameters].filter((one) => one !== "");
}

function change(name: string, before: string | undefined, after: string | undefined): string {
  return before === after ? "" : `${name} ${before ?? "(default)"} → ${after ?? "(default)"}`;
}
