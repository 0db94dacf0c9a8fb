// A link on the canvas, with the value that it carries.

import { BaseEdge, getBezierPath, type Edge, type EdgeProps } from "@xyflow/react";
import { memo, useContext, useEffect, useRef } from "react";
import { endText, type Wire } from "./composition";
import { Live } from "./node";
import { wireColor } from "./wire_color";

export type WireEdge = Edge<{ wire: Wire; live: boolean }, "wire">;

export const WireView = memo(function WireView(props: EdgeProps<WireEdge>) {
  const [path] = getBezierPath(props);
  const { wire, live } = props.data!;
  const classes = ["wire", wire.problem ? "broken" : "", wire.network ? "other" : "", props.selected ? "chosen" : ""].join(" ");
  return (
    <g className={classes} style={{ ["--wire" as string]: wireColor(wire.datatype) }}>
      <BaseEdge id={props.id} path={path} interactionWidth={14} />
      {wire.problem ? <title>{wire.problem}</title> : null}
      {live && wire.network === "" ? <Value port={endText(wire.source, wire.output)} x={props.sourceX + 8} y={props.sourceY - 5} /> : null}
    </g>
  );
});

function Value({ port, x, y }: { port: string; x: number; y: number }) {
  const live = useContext(Live);
  const place = useRef<SVGTextElement>(null);
  useEffect(() => live.show(port, place.current!), [live, port]);
  return <text className="value" x={x} y={y} ref={place} data-value={port} />;
}
