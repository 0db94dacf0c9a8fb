// The graph: parts that are moved, ports that are wired, things that are dropped.

import {
  applyNodeChanges,
  Background,
  Controls,
  MiniMap,
  ReactFlow,
  useReactFlow,
  type Connection,
  type FinalConnectionState,
  type NodeChange,
  type OnConnectStartParams,
} from "@xyflow/react";
import { useCallback, useEffect, useMemo, useRef, useState, type DragEvent, type MouseEvent } from "react";
import { arrange } from "./arrange";
import { endText, ends, placed, type Composition } from "./composition";
import { linkKey, type ComposerDocument } from "./document";
import { addLink, move } from "./edits";
import { InHand, PartView, type PartNode } from "./node";
import type { Box, Network } from "./network";
import { useStore } from "./store";
import { WireView, type WireEdge } from "./wire";
import { canLink } from "./wiring";

export type Mode = "edit" | "wiring";
/** What a drag from the palette carries. */
export const BEHAVIOR_TYPE = "application/x-hri-behavior";

const NODES = { part: PartView };
const EDGES = { wire: WireView };
/** So far out that a chain of 1,000 behaviors is shown whole. */
const MIN_ZOOM = 0.003;
/** Pixels. */
const MAP_SIZE = { width: 130, height: 90 };

interface CanvasProps {
  doc: ComposerDocument;
  composition: Composition;
  mode: Mode;
  /** Whether all networks of the app are shown, placed together whatever the file says. */
  isWhole: boolean;
  isLive: boolean;
  add(type: string, at: Box): void;
  openOther(network: string): void;
  menu(event: MouseEvent, id: string): void;
  hover(port: string, at: { x: number; y: number } | null): void;
}

export function Canvas({ doc, composition, mode, isWhole, isLive, add, openOther, menu, hover }: CanvasProps) {
  const flow = useReactFlow<PartNode, WireEdge>();
  const selection = useStore(doc.selection);
  const path = useStore(doc.path);
  const places = usePlaces(composition, path, isWhole);
  const [nodes, setNodes] = useState<PartNode[]>([]);
  const [inHand, setInHand] = useState<ReadonlyMap<string, string> | null>(null);
  const gesture = useRef(0);

  useEffect(() => {
    setNodes((before) => {
      const known = new Map(before.map((one) => [one.id, one]));
      return [...composition.parts].map(([key, part]): PartNode => {
        const had = known.get(key);
        const isOwn = part.network === "";
        const position = had?.dragging ? had.position : places.get(key)!;
        const selected = isOwn && selection.ids.has(part.id);
        const isKept = had && had.data.part === part && had.data.live === isLive && had.selected === selected && had.position.x === position.x && had.position.y === position.y;
        if (isKept) return had;
        return {
          ...had,
          id: key,
          type: "part",
          position,
          selected,
          data: { part, live: isLive && isOwn },
          width: part.width,
          height: part.height,
          className: isOwn ? "" : "other",
          draggable: isOwn,
          selectable: isOwn,
          ariaLabel: ariaLabel(part.title, part.type, part.problems.length),
        };
      });
    });
  }, [composition, places, selection, isLive]);

  const drawn = useRef(new Map<string, WireEdge>());
  const edges = useMemo(() => {
    const next = composition.wires.map((wire): WireEdge => {
      const had = drawn.current.get(wire.id);
      const selected = wire.network === "" && selection.links.has(linkKey(wire.link));
      if (had && had.data!.wire === wire && had.data!.live === isLive && had.selected === selected) return had;
      return {
        id: wire.id,
        type: "wire",
        source: wire.source,
        target: wire.target,
        sourceHandle: wire.output,
        targetHandle: wire.input,
        selected,
        selectable: wire.network === "",
        data: { wire, live: isLive },
        ariaLabel: `Link from ${wire.link.from} to ${wire.link.to}${wire.problem ? `, ${wire.problem}` : ""}`,
      };
    });
    drawn.current = new Map(next.map((one) => [one.id, one]));
    return next;
  }, [composition, selection, isLive]);

  const isEmpty = composition.parts.size === 0;
  const wasEmpty = useRef(isEmpty);
  wasEmpty.current = isEmpty;
  useEffect(() => {
    if (wasEmpty.current) return; // what is dropped first stays where it was dropped
    const frame = requestAnimationFrame(() => void flow.fitView({ padding: 0.1, maxZoom: 1.2 }));
    return () => cancelAnimationFrame(frame);
  }, [path, isWhole, flow]);

  const changeNodes = useCallback(
    (changes: NodeChange<PartNode>[]) => {
      setNodes((before) => applyNodeChanges(changes, before));
      const moved = new Map<string, Box>();
      for (const change of changes)
        if (change.type === "position" && !change.dragging && change.position)
          moved.set(change.id, { x: Math.round(change.position.x), y: Math.round(change.position.y) });
      if (moved.size > 0) doc.apply(move(doc.network, moved), moved.size > 1 ? `move ${moved.size} parts` : `move ${[...moved.keys()][0]}`, `move ${gesture.current}`);
      if (changes.some((one) => one.type === "select")) {
        const chosen = new Set(doc.selection.value.ids);
        for (const change of changes)
          if (change.type === "select") {
            if (change.selected) chosen.add(change.id);
            else chosen.delete(change.id);
          }
        doc.select(chosen, doc.selection.value.links);
      }
    },
    [doc],
  );

  const changeEdges = useCallback(
    (changes: { type: string; id?: string; selected?: boolean }[]) => {
      const links = new Set(doc.selection.value.links);
      for (const change of changes) {
        const wire = composition.wires.find((one) => one.id === change.id);
        if (change.type !== "select" || !wire) continue;
        if (change.selected) links.add(linkKey(wire.link));
        else links.delete(linkKey(wire.link));
      }
      doc.select(doc.selection.value.ids, links);
    },
    [doc, composition],
  );

  const verdict = useCallback(
    (one: Pick<Connection, "source" | "target" | "sourceHandle" | "targetHandle">) =>
      canLink(doc.network, doc.palette.value, endText(one.source, one.sourceHandle ?? ""), endText(one.target, one.targetHandle ?? "")),
    [doc],
  );

  const connect = useCallback(
    (one: Connection) => {
      const from = endText(one.source, one.sourceHandle ?? "");
      const to = endText(one.target, one.targetHandle ?? "");
      const found = verdict(one);
      if (!found.ok) return doc.notice.set(`not linked: ${found.reason}`);
      doc.apply(addLink(doc.network, from, to), `link ${from} to ${to}`);
      doc.notice.set(found.warning ? `linked, but ${found.warning}` : `linked ${from} to ${to}`);
    },
    [doc, verdict],
  );

  const takeInHand = useCallback(
    (_: unknown, begun: OnConnectStartParams) => {
      const isFromOutput = begun.handleType === "source";
      const found = new Map<string, string>();
      for (const [key, part] of composition.parts) {
        if (part.network !== "") continue;
        for (const port of isFromOutput ? part.inputs : part.outputs) {
          const [source, target] = [{ node: begun.nodeId!, port: begun.handleId! }, { node: key, port: port.name }];
          const [from, to] = isFromOutput ? [source, target] : [target, source];
          const one = verdict({ source: from.node, sourceHandle: from.port, target: to.node, targetHandle: to.port });
          found.set(`${isFromOutput ? "in" : "out"}:${key}:${port.name}`, one.ok ? "" : one.reason);
        }
      }
      setInHand(found);
    },
    [composition, verdict],
  );

  const letGo = useCallback(
    (_: unknown, ended: FinalConnectionState) => {
      setInHand(null);
      const { fromHandle, toHandle, isValid } = ended;
      if (isValid || !fromHandle || !toHandle) return;
      const isFromOutput = fromHandle.type === "source";
      if (fromHandle.type === toHandle.type) return doc.notice.set(`not linked: two ${isFromOutput ? "outputs" : "inputs"} - link an output to an input`);
      const [from, to] = isFromOutput ? [fromHandle, toHandle] : [toHandle, fromHandle];
      const found = verdict({ source: from.nodeId, sourceHandle: from.id ?? "", target: to.nodeId, targetHandle: to.id ?? "" });
      if (!found.ok) doc.notice.set(`not linked: ${found.reason}`);
    },
    [doc, verdict],
  );

  const drop = (event: DragEvent) => {
    const type = event.dataTransfer.getData(BEHAVIOR_TYPE);
    if (!type) return;
    event.preventDefault();
    const { x, y } = flow.screenToFlowPosition({ x: event.clientX, y: event.clientY });
    add(type, { x: Math.round(x), y: Math.round(y) });
  };

  const point = (event: MouseEvent) => {
    const target = event.target as Element;
    const port = target.closest("[data-port]")?.getAttribute("data-port") ?? target.closest(".react-flow__edge")?.querySelector("[data-value]")?.getAttribute("data-value");
    hover(port ?? "", port ? { x: event.clientX, y: event.clientY } : null);
  };

  return (
    <div className={`canvas ${mode}`} onDrop={drop} onDragOver={(event) => event.dataTransfer.types.includes(BEHAVIOR_TYPE) && event.preventDefault()} onMouseOver={isLive ? point : undefined}>
      <InHand value={inHand}>
        <ReactFlow<PartNode, WireEdge>
          nodes={nodes}
          edges={edges}
          nodeTypes={NODES}
          edgeTypes={EDGES}
          onNodesChange={changeNodes}
          onEdgesChange={changeEdges}
          onConnect={connect}
          onConnectStart={takeInHand}
          onConnectEnd={letGo}
          onClickConnectStart={takeInHand}
          onClickConnectEnd={letGo}
          isValidConnection={(one) => verdict(one as Connection).ok}
          onNodeDragStart={() => gesture.current++}
          onNodeClick={(_, { data: { part } }) => part.network && doc.notice.set(`${part.id} is in ${part.network} - a double-click opens it`)}
          onNodeDoubleClick={(_, node) => node.data.part.network && openOther(node.data.part.network)}
          onNodeContextMenu={(event, node) => node.data.part.network === "" && menu(event, node.id)}
          onPaneClick={() => doc.select([])}
          nodesDraggable={mode === "edit" && !isWhole}
          deleteKeyCode={null}
          selectionKeyCode="Shift"
          multiSelectionKeyCode={["Shift", "Control", "Meta"]}
          zoomOnDoubleClick={false}
          connectionRadius={24}
          minZoom={MIN_ZOOM}
          maxZoom={2}
          colorMode="system"
          onlyRenderVisibleElements={nodes.length > 150}
        >
          <Background gap={20} />
          <Controls showInteractive={false} />
          <MiniMap style={MAP_SIZE} pannable zoomable nodeColor="var(--quiet)" maskColor="var(--mask)" ariaLabel="Map of the network" />
        </ReactFlow>
      </InHand>
    </div>
  );
}

function ariaLabel(title: string, type: string, problems: number): string {
  return `${title}, ${type}${problems ? `, ${problems} problems` : ""}`;
}

/** Where the parts stand. Those without a place in the file get one when they come, and keep it. */
function usePlaces(composition: Composition, path: string, isWhole: boolean): Map<string, Box> {
  const kept = useRef({ path, arranged: new Map<string, Box>() });
  return useMemo(() => {
    if (isWhole) return arrangedParts(composition);
    if (kept.current.path !== path) kept.current = { path, arranged: new Map() };
    const { arranged } = kept.current;
    const isNew = [...composition.parts].some(([key, part]) => !part.at && !arranged.has(key));
    if (isNew)
      for (const [key, box] of arrangedParts(composition)) if (!arranged.has(key)) arranged.set(key, box);
    return placed(composition, arranged);
  }, [composition, path, isWhole]);
}

/** All parts from left to right, whichever network they belong to. */
export function arrangedParts(composition: Composition): Map<string, Box> {
  const keyOf = (network: string, text: string) => {
    const { id, port } = ends(text);
    return endText(network && !id.startsWith("board.") ? `${network}/${id}` : id, port);
  };
  const whole = {
    behaviors: [...composition.parts].filter(([, part]) => part.kind === "behavior").map(([id]) => ({ id })),
    links: composition.wires.map(({ network, link }) => ({ from: keyOf(network, link.from), to: keyOf(network, link.to) })),
  } as unknown as Network;
  return arrange(whole, (id) => composition.parts.get(id) ?? { width: 120, height: 60 });
}

