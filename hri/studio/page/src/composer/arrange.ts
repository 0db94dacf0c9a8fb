// Places parts from left to right, in the order in which values go.

import { Graph, layout } from "@dagrejs/dagre";
import { isSlot, ownerOf, type Box, type Network } from "./network";

const BETWEEN_LAYERS = 90;
const BETWEEN_PARTS = 30;
const MARGIN = 40;

/** By id; the slots of the board are parts as well. `size` is in pixels. */
export function arrange(n: Pick<Network, "behaviors" | "links">, size: (id: string) => { width: number; height: number }): Map<string, Box> {
  const graph = new Graph();
  graph.setGraph({ rankdir: "LR", ranker: "tight-tree", ranksep: BETWEEN_LAYERS, nodesep: BETWEEN_PARTS, marginx: MARGIN, marginy: MARGIN });
  graph.setDefaultEdgeLabel(() => ({}));
  const ids = new Set(n.behaviors.map((one) => one.id));
  const put = (id: string) => {
    if (!graph.hasNode(id)) graph.setNode(id, { ...size(id) });
  };
  for (const id of ids) put(id);
  for (const { from, to } of n.links) {
    for (const end of [from, to]) if (isSlot(end)) put(end);
    const [source, target] = [ownerOf(from), ownerOf(to)];
    if (graph.hasNode(source) && graph.hasNode(target)) graph.setEdge(source, target);
  }
  if (graph.nodeCount() === 0) return new Map();
  layout(graph);
  return new Map(
    graph.nodes().map((id: string) => {
      const { x, y, width, height } = graph.node(id) as { x: number; y: number; width: number; height: number };
      return [id, { x: Math.round(x - width / 2), y: Math.round(y - height / 2) }];
    }),
  );
}
