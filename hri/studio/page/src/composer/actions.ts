// What a person can do to a network: one table behind toolbar, keys, and the list of keys.

import { arrangedParts, type Mode } from "./canvas";
import { copyByButton, deleteChosen, pasteByButton } from "./clipboard";
import type { Composition } from "./composition";
import type { ComposerDocument } from "./document";
import { addBehavior, freeId, idFor, move } from "./edits";
import type { Box } from "./network";

export interface Action {
  id: string;
  label: string;
  about: string;
  /** As KeyboardEvent.key has it, with "Ctrl+" and "Shift+" before; Cmd counts as Ctrl. */
  keys: string[];
  /** The browser knows the keys, and brings or takes the clipboard with them. */
  isOfClipboard?: true;
  /** Of the toolbar; without one it has a key alone. */
  group?: "file" | "edit" | "look";
  isPossible?(): boolean;
  isOn?(): boolean;
  run(): void;
}

/** What the actions need beside the document. */
export interface Desk {
  doc: ComposerDocument;
  composition(): Composition;
  places(): ReadonlyMap<string, Box>;
  mode: Mode;
  setMode(mode: Mode): void;
  isWhole: boolean;
  setWhole(isWhole: boolean): void;
  hasApp: boolean;
  isTextShown: boolean;
  showText(isShown: boolean): void;
  ask(dialog: "open" | "new" | "save as"): void;
  fit(): void;
}

/** Between a new behavior and the lowest one. */
const BELOW = 40;

export function actionsOf(desk: Desk): Action[] {
  const { doc } = desk;
  const { history } = doc;
  const chosen = () => [...doc.selection.value.ids];
  const isAny = () => chosen().length + doc.selection.value.links.size > 0;
  const isReadable = () => history.error === null;
  const align = (side: "x" | "y") => {
    const places = new Map(chosen().map((id) => [id, desk.places().get(id)!]));
    const edge = Math.min(...[...places.values()].map((one) => one[side]));
    doc.apply(move(doc.network, new Map([...places].map(([id, box]) => [id, { ...box, [side]: edge }]))), "align");
  };
  return [
    { id: "new", label: "New", about: "begin a new network", keys: [], group: "file", run: () => desk.ask("new") },
    { id: "open", label: "Open", about: "open a network", keys: ["Ctrl+o"], group: "file", run: () => desk.ask("open") },
    { id: "save", label: "Save", about: "save the network", keys: ["Ctrl+s"], group: "file", isPossible: () => doc.path.value !== "", run: () => void (doc.why ? desk.ask("save as") : doc.save()) },
    { id: "save-as", label: "Save as", about: "save it as another file", keys: ["Ctrl+Shift+S"], group: "file", isPossible: () => doc.path.value !== "", run: () => desk.ask("save as") },
    { id: "undo", label: "Undo", about: "undo the last change", keys: ["Ctrl+z"], group: "edit", isPossible: () => history.undoLabel !== null, run: () => doc.undo() },
    { id: "redo", label: "Redo", about: "do again what was undone", keys: ["Ctrl+Shift+Z", "Ctrl+y"], group: "edit", isPossible: () => history.redoLabel !== null, run: () => doc.redo() },
    { id: "copy", label: "Copy", about: "copy what is selected", keys: ["Ctrl+c"], isOfClipboard: true, group: "edit", isPossible: () => isReadable() && chosen().length > 0, run: () => void copyByButton(doc) },
    { id: "cut", label: "Cut", about: "cut what is selected out", keys: ["Ctrl+x"], isOfClipboard: true, isPossible: () => isReadable() && chosen().length > 0, run: () => { void copyByButton(doc); deleteChosen(doc); } },
    { id: "paste", label: "Paste", about: "paste what was copied, here or elsewhere", keys: ["Ctrl+v"], isOfClipboard: true, group: "edit", isPossible: () => isReadable() && doc.path.value !== "", run: () => void pasteByButton(doc) },
    { id: "delete", label: "Delete", about: "delete what is selected", keys: ["Delete", "Backspace"], group: "edit", isPossible: () => isReadable() && isAny(), run: () => deleteChosen(doc) },
    { id: "select-all", label: "Select all", about: "select all behaviors", keys: ["Ctrl+a"], run: () => doc.select(doc.network.behaviors.map((one) => one.id)) },
    {
      id: "arrange", label: "Arrange", about: "place all parts from left to right", keys: ["a"], group: "look", isPossible: isReadable,
      run: () => {
        const own = new Map([...desk.composition().parts].filter(([, part]) => part.network === ""));
        const wires = desk.composition().wires.filter((one) => one.network === "");
        doc.apply(move(doc.network, arrangedParts({ parts: own, wires })), "arrange");
        desk.fit();
      },
    },
    { id: "align-left", label: "Align left", about: "put what is selected below each other", keys: [], group: "look", isPossible: () => chosen().length > 1, run: () => align("x") },
    { id: "align-top", label: "Align top", about: "put what is selected beside each other", keys: [], group: "look", isPossible: () => chosen().length > 1, run: () => align("y") },
    { id: "fit", label: "Fit", about: "show the whole network", keys: ["f"], group: "look", run: () => desk.fit() },
    { id: "edit-mode", label: "Edit", about: "move parts and wire them", keys: ["e"], group: "look", isOn: () => desk.mode === "edit", run: () => desk.setMode("edit") },
    { id: "wiring-mode", label: "Wiring", about: "wire ports alone: click an output, then an input", keys: ["w"], group: "look", isOn: () => desk.mode === "wiring", run: () => desk.setMode("wiring") },
    { id: "whole", label: "Whole app", about: "show all networks of the app together", keys: ["g"], group: "look", isPossible: () => desk.hasApp, isOn: () => desk.isWhole, run: () => desk.setWhole(!desk.isWhole) },
    { id: "text", label: "XML", about: "show the XML beside the graph", keys: ["x"], group: "look", isOn: () => desk.isTextShown, run: () => desk.showText(!desk.isTextShown) },
  ];
}

/** Add a behavior, where it was dropped or below the others, and select it. */
export function addOne(desk: Pick<Desk, "doc" | "composition" | "places">, type: string, at?: Box): void {
  const { doc } = desk;
  if (doc.history.error !== null) return doc.notice.set("the XML cannot be read - fix it first, or undo");
  const id = freeId(doc.network, idFor(type));
  doc.apply(addBehavior(doc.network, { id, type }, at ?? below(desk)), `add ${id}`);
  doc.select([id]);
  doc.notice.set(`added ${id}`);
}

function below({ composition, places }: Pick<Desk, "composition" | "places">): Box {
  const own = [...composition().parts].filter(([, part]) => part.network === "");
  if (own.length === 0) return { x: 40, y: 40 };
  const boxes = own.map(([key, part]) => ({ ...places().get(key)!, height: part.height }));
  return { x: Math.min(...boxes.map((one) => one.x)), y: Math.max(...boxes.map((one) => one.y + one.height)) + BELOW };
}

/** The keys of an event, as the table has them. */
export function keysOf(event: Pick<KeyboardEvent, "key" | "ctrlKey" | "metaKey" | "shiftKey">): string {
  const isCommand = event.ctrlKey || event.metaKey;
  return `${isCommand ? "Ctrl+" : ""}${isCommand && event.shiftKey ? "Shift+" : ""}${event.key}`;
}

