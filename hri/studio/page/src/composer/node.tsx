// A behavior, or a slot of the board, on the canvas.

import { Handle, Position, type Node, type NodeProps } from "@xyflow/react";
import { createContext, memo, useContext, useEffect, useRef } from "react";
import type { Part } from "./composition";
import { FOOT, ROW, TITLE } from "./composition";
import type { LiveValues } from "./live_values";
import { useStore } from "./store";
import { wireColor } from "./wire_color";
import type { Port } from "./wiring";

export type PartNode = Node<{ part: Part; live: boolean }, "part">;

export const Live = createContext<LiveValues>(null as unknown as LiveValues);
/** Ports that the wire in hand may end at, and why others refuse it; null while there is none. */
export const InHand = createContext<ReadonlyMap<string, string> | null>(null);

export const PartView = memo(function PartView({ id, data, selected }: NodeProps<PartNode>) {
  const { part } = data;
  const inHand = useContext(InHand);
  const isBroken = part.problems.some((one) => one.grave === "error");
  const problem = part.problems.map((one) => `${one.what} - ${one.remedy}`).join("\n");
  const classes = ["part", part.kind, part.isSensor ? "sensor" : "", isBroken ? "broken" : problem ? "doubtful" : "", selected ? "chosen" : ""];
  return (
    <div className={classes.join(" ")} style={{ width: part.width, height: part.height }} title={problem || undefined}>
      <strong>{part.title}</strong>
      <small>{part.type}</small>
      {part.inputs.map((port, row) => <PortView key={port.name} side="in" part={part} node={id} port={port} row={row} inHand={inHand} />)}
      {part.outputs.map((port, row) => <PortView key={port.name} side="out" part={part} node={id} port={port} row={row} inHand={inHand} />)}
      {data.live && part.kind === "behavior" ? <Cost id={part.id} /> : null}
      {data.live ? <Thumbnails part={part} /> : null}
    </div>
  );
});

interface PortProps {
  side: "in" | "out";
  part: Part;
  node: string;
  port: Port;
  row: number;
  inHand: ReadonlyMap<string, string> | null;
}

function PortView({ side, part, node, port, row, inHand }: PortProps) {
  const isInput = side === "in";
  const refusal = inHand?.get(`${side}:${node}:${port.name}`);
  const state = inHand === null ? "" : refusal === undefined ? "closed" : refusal === "" ? "open" : "closed";
  const about = [`${port.name} (${port.datatype || "unknown"})`, port.description, refusal].filter(Boolean).join("\n");
  return (
    <Handle
      id={port.name}
      type={isInput ? "target" : "source"}
      position={isInput ? Position.Left : Position.Right}
      className={`port ${side} ${state}`}
      style={{ top: TITLE + (row + 0.5) * ROW, ["--wire" as string]: wireColor(port.datatype) }}
      isConnectable={part.network === ""}
      title={about}
      data-port={`${part.id}.${port.name}`}
    >
      <span>{part.kind === "slot" ? "" : port.name}</span>
    </Handle>
  );
}

function Cost({ id }: { id: string }) {
  const live = useContext(Live);
  const place = useRef<HTMLSpanElement>(null);
  useEffect(() => live.showCost(id, place.current!), [live, id]);
  return <span className="cost" style={{ height: FOOT }} ref={place} />;
}

function Thumbnails({ part }: { part: Part }) {
  const live = useContext(Live);
  const all = useStore(live.thumbnails);
  return part.outputs
    .map((port) => all[`${live.name}/${part.id}.${port.name}`])
    .filter((jpeg) => jpeg !== undefined)
    .map((jpeg, number) => <Thumbnail key={number} jpeg={jpeg} of={part.id} />);
}

function Thumbnail({ jpeg, of }: { jpeg: string; of: string }) {
  const place = useRef<HTMLImageElement>(null);
  useEffect(() => {
    const bytes = Uint8Array.from(atob(jpeg), (letter) => letter.charCodeAt(0));
    const address = URL.createObjectURL(new Blob([bytes], { type: "image/jpeg" }));
    place.current!.src = address;
    return () => URL.revokeObjectURL(address);
  }, [jpeg]);
  return <img className="thumbnail" ref={place} alt={`what ${of} sends`} />;
}
