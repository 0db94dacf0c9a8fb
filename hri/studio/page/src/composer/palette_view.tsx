// The behaviors by category, with a search: dragged onto the canvas, or added by Enter.

import { useMemo, useState, type KeyboardEvent } from "react";
import { BEHAVIOR_TYPE } from "./canvas";
import type { BehaviorType, Palette } from "./wiring";

interface PaletteProps {
  palette: Palette;
  add(type: string): void;
  showSchema(type: string): void;
}

export function PaletteView({ palette, add, showSchema }: PaletteProps) {
  const [words, setWords] = useState("");
  const [closed, setClosed] = useState<ReadonlySet<string>>(new Set());
  const groups = useMemo(() => grouped(palette, words), [palette, words]);
  const first = groups[0]?.[1][0];

  const toggle = (category: string) => {
    const next = new Set(closed);
    if (!next.delete(category)) next.add(category);
    setClosed(next);
  };
  const walk = (event: KeyboardEvent) => {
    const step = { ArrowDown: 1, ArrowUp: -1 }[event.key];
    if (step === undefined) return;
    event.preventDefault();
    const stops = [...event.currentTarget.querySelectorAll<HTMLElement>("input, button.behavior")];
    stops[stops.indexOf(event.target as HTMLElement) + step]?.focus();
  };

  return (
    <nav className="palette" aria-label="Behaviors" onKeyDown={walk}>
      <input
        id="palette-search"
        type="search"
        aria-label="Search behaviors"
        placeholder="Search behaviors"
        value={words}
        onChange={(event) => setWords(event.target.value)}
        onKeyDown={(event) => {
          if (event.key === "Enter" && first) add(first.type);
        }}
      />
      <div className="groups">
        {groups.map(([category, behaviors]) => (
          <section key={category}>
            <button type="button" className="category" aria-expanded={!closed.has(category) || words !== ""} onClick={() => toggle(category)}>
              {category} <small>{behaviors.length}</small>
            </button>
            {closed.has(category) && words === ""
              ? null
              : behaviors.map((one) => (
                  <button
                    key={one.type}
                    type="button"
                    className="behavior"
                    draggable
                    title={`${one.type}\n${one.about}`}
                    onDragStart={(event) => event.dataTransfer.setData(BEHAVIOR_TYPE, one.type)}
                    onClick={() => add(one.type)}
                    onContextMenu={(event) => {
                      event.preventDefault();
                      showSchema(one.type);
                    }}
                  >
                    {one.display_name} <small>{one.type}</small>
                  </button>
                ))}
          </section>
        ))}
        {groups.length === 0 ? <p className="quiet">No behavior has “{words}” in its name.</p> : null}
        {palette.broken.map((one) => (
          <p key={one.type} className="wrong" title={one.what}>{one.type} cannot be used: {one.what}</p>
        ))}
      </div>
    </nav>
  );
}

/** By category; with words those whose name has them first, then those whose text has them. */
export function grouped(palette: Palette, words: string): [string, BehaviorType[]][] {
  const wanted = words.toLowerCase().split(/\s+/).filter(Boolean);
  const has = (text: string) => wanted.every((word) => text.toLowerCase().includes(word));
  const named = palette.behaviors.filter((one) => has(`${one.type} ${one.display_name}`));
  const told = wanted.length ? palette.behaviors.filter((one) => !named.includes(one) && has(`${one.category} ${one.about}`)) : [];
  const groups = new Map<string, BehaviorType[]>();
  for (const one of [...named, ...told]) groups.set(one.category, [...(groups.get(one.category) ?? []), one]);
  const sorted = [...groups];
  return wanted.length ? sorted : sorted.sort(([a], [b]) => a.localeCompare(b));
}
