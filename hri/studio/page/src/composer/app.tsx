// The composer: palette, graph, properties, XML, and what runs.

import { ReactFlowProvider, useReactFlow } from "@xyflow/react";
import { lazy, Suspense, useCallback, useEffect, useMemo, useRef, useState, type MouseEvent } from "react";
import { actionsOf, addOne, keysOf, type Action, type Desk } from "./actions";
import { Canvas, type Mode } from "./canvas";
import { copyChosen, deleteChosen, pasteText } from "./clipboard";
import { compose, settled, together, type Composition } from "./composition";
import { BreakDialog, NameDialog, OpenDialog, QuestionDialog, TextDialog } from "./dialogs";
import type { ComposerDocument } from "./document";
import type { LiveValues } from "./live_values";
import { readNetwork, type Box, type Network } from "./network";
import { Live } from "./node";
import { PaletteView } from "./palette_view";
import { Probe, Why, type Pointed } from "./probe";
import { Properties } from "./properties";
import { RunBar, type Ask } from "./run_bar";
import * as server from "./server";
import { useStore } from "./store";
import { portsOf } from "./wiring";

const Source = lazy(() => import("./source").then(({ Source }) => ({ default: Source })));

/** Pictures beside their nodes, at once. */
const MOST_THUMBNAILS = 4;

export interface ComposerProps {
  doc: ComposerDocument;
  live: LiveValues;
  ask: Ask;
  open(path: string): void;
  want(networks: string[], thumbnails: string[], reasons: string[]): void;
}

type Asked = { kind: "open" | "new" | "save as" } | { kind: "break"; port: string } | { kind: "schema"; title: string; text: string };

export function Composer(props: ComposerProps) {
  return (
    <ReactFlowProvider>
      <Live value={props.live}>
        <Desktop {...props} />
      </Live>
    </ReactFlowProvider>
  );
}

function Desktop({ doc, live, ask, open, want }: ComposerProps) {
  const flow = useReactFlow();
  const path = useStore(doc.path);
  const revision = useStore(doc.revision);
  const palette = useStore(doc.palette);
  const problems = useStore(doc.problems);
  const question = useStore(doc.question);
  const { networks: files, home } = useStore(doc.files);
  const networks = useStore(live.networks);
  useStore(doc.selection);
  const [mode, setMode] = useState<Mode>("edit");
  const [isWhole, setWhole] = useState(false);
  const [isTextShown, showText] = useState(false);
  const [asked, setAsked] = useState<Asked | null>(null);
  const [pointed, setPointed] = useState<Pointed | null>(null);
  const [whyPort, setWhyPort] = useState("");
  const [menu, setMenu] = useState<{ id: string; x: number; y: number } | null>(null);

  const app = files.find((one) => one.path === path)?.app ?? null;
  const others = useOthers(isWhole ? app : null, path, files, doc);
  const current = useRef<Composition>({ parts: new Map(), wires: [] });
  const composition = useMemo(() => {
    const own = compose(doc.network, palette, problems);
    const all = others.size === 0 ? own : together(own, [...others].map(([name, network]) => compose(network, { ...palette, datatypes: {} }, [], name)));
    current.current = settled(current.current, all);
    return current.current;
  }, [doc, revision, palette, problems, others]);

  const running = networks.find((one) => one.path === path);
  const isLive = running !== undefined;
  const images = useMemo(() => imagePorts(doc.network, palette, running?.name ?? ""), [doc, revision, palette, running?.name]);
  useEffect(() => {
    live.follow(running?.name ?? "");
    want(running ? [running.name] : [], images, running && whyPort ? [`${running.name}/${whyPort}`] : []);
    return () => want([], [], []);
  }, [live, running?.name, images, whyPort, want]);

  const desk: Desk = {
    doc,
    composition: () => current.current,
    places: () => new Map(flow.getNodes().map((one) => [one.id, one.position])),
    mode,
    setMode,
    isWhole,
    setWhole,
    hasApp: app !== null,
    isTextShown,
    showText,
    ask: (kind) => setAsked({ kind }),
    fit: () => requestAnimationFrame(() => void flow.fitView({ padding: 0.1, maxZoom: 1.2 })),
  };
  const actions = actionsOf(desk);
  const place = useRef<HTMLDivElement>(null);
  useKeys(actions, place);
  useClipboard(doc, place);
  const focusOnSearch = useFocusBack(asked !== null || question !== null);
  const isShown = useRef(isTextShown);
  useEffect(() => {
    if (isShown.current !== isTextShown) desk.fit(); // the graph has another width
    isShown.current = isTextShown;
  });

  const add = (type: string, at?: Box) => addOne(desk, type, at);
  const showSchema = useCallback(
    (type: string) =>
      void doc.attempt(async () => {
        const found = await server.schema(type);
        setAsked({ kind: "schema", title: `Schema of ${type}`, text: found.text });
      }),
    [doc],
  );
  const openOther = useCallback(
    (name: string) => {
      const found = files.find((one) => one.app === app && one.name === name);
      if (found) open(found.path);
    },
    [files, app, open],
  );
  const openMenu = useCallback((event: MouseEvent, id: string) => {
    event.preventDefault();
    doc.select([id]);
    setMenu({ id, x: event.clientX, y: event.clientY });
  }, [doc]);
  const hover = useCallback((port: string, at: { x: number; y: number } | null) => setPointed(at === null ? null : { port, ...at }), []);
  const create = (path: string) => {
    doc.create(path);
    open(path);
    focusOnSearch(); // what comes next is to add a behavior
  };
  /** A plain new name in the folder of new networks is taken at once; the server knows about others. */
  const begin = (path: string) => {
    const isPlain = path.startsWith(`${home}/`) && /^[^./~][^/]*$/.test(path.slice(home.length + 1));
    if (isPlain && !files.some((one) => one.path === path)) return create(path);
    return server.begin(path).then((found) => create(found.path));
  };
  const breakAt = (port: string) => setAsked({ kind: "break", port });

  return (
    <div className={isTextShown ? "composer with-text" : "composer"} ref={place} onClick={() => setMenu(null)}>
      <Toolbar actions={actions} />
      <RunBar doc={doc} live={live} running={running} ask={ask} breakAt={breakAt} />
      <PaletteView palette={palette} add={add} showSchema={showSchema} />
      <section className="graph" aria-label="Network">
        <Canvas doc={doc} composition={composition} mode={mode} isWhole={others.size > 0} isLive={isLive} add={add} openOther={openOther} menu={openMenu} hover={hover} />
        {doc.history.error ? <p className="unreadable" role="alert">The XML cannot be read: {doc.history.error.message}. The graph shows it as it was.</p> : null}
        {path === "" ? <Welcome ask={desk.ask} /> : doc.network.behaviors.length === 0 ? <p className="hint">Drag a behavior here from the left, or search for one and press Enter.</p> : null}
      </section>
      <aside className="side" aria-label="Properties">
        {whyPort && isLive ? <Why doc={doc} live={live} port={whyPort} close={() => setWhyPort("")} /> : <Properties doc={doc} isLive={isLive} why={setWhyPort} breakAt={breakAt} />}
      </aside>
      {isTextShown ? <Suspense fallback={<p className="xml-source quiet">…</p>}><Source doc={doc} /></Suspense> : null}
      <StatusBar doc={doc} />
      {pointed && isLive ? <Probe doc={doc} live={live} pointed={pointed} /> : null}
      {menu ? <Menu {...menu} doc={doc} actions={actions} showSchema={showSchema} /> : null}
      {asked?.kind === "open" ? <OpenDialog doc={doc} open={open} close={() => setAsked(null)} /> : null}
      {asked?.kind === "new" ? <NameDialog doc={doc} title="New network" remark="It is written when you save it." take={begin} close={() => setAsked(null)} /> : null}
      {asked?.kind === "save as" ? <NameDialog doc={doc} title="Save as" remark={doc.why || "Another file, which is open then."} take={async (name) => open(await doc.saveAs(name))} close={() => setAsked(null)} /> : null}
      {asked?.kind === "schema" ? <TextDialog title={asked.title} text={asked.text} close={() => setAsked(null)} /> : null}
      {asked?.kind === "break" ? (
        <BreakDialog
          port={asked.port}
          condition={running?.breakpoint?.port === asked.port ? running.breakpoint.condition : ""}
          take={async (condition) => {
            if (!(await ask("network_break", { name: running?.name ?? "", port: asked.port, condition }))) throw new Error(doc.notice.value);
          }}
          close={() => setAsked(null)}
        />
      ) : null}
      {question ? <QuestionDialog doc={doc} question={question} /> : null}
    </div>
  );
}

function Toolbar({ actions }: { actions: Action[] }) {
  const groups = ["file", "edit", "look"] as const;
  return (
    <div className="toolbar" role="toolbar" aria-label="Network">
      {groups.map((group) => (
        <span key={group} className="group">
          {actions.filter((one) => one.group === group).map((one) => (
            <button
              key={one.id}
              type="button"
              data-action={one.id}
              title={[one.about, one.keys.join(" or ")].filter(Boolean).join(": ")}
              disabled={one.isPossible ? !one.isPossible() : false}
              aria-pressed={one.isOn?.()}
              onClick={one.run}
            >
              {one.label}
            </button>
          ))}
        </span>
      ))}
    </div>
  );
}

function StatusBar({ doc }: { doc: ComposerDocument }) {
  useStore(doc.revision);
  const path = useStore(doc.path);
  const notice = useStore(doc.notice);
  const draft = useStore(doc.autosave.state);
  const left = useStore(doc.autosave.left);
  const problems = useStore(doc.problems);
  const errors = problems.filter((one) => one.grave === "error").length;
  const counts = [errors ? `${errors} ${errors === 1 ? "error" : "errors"}` : "", problems.length > errors ? `${problems.length - errors} ${problems.length - errors === 1 ? "warning" : "warnings"}` : ""].filter(Boolean);
  return (
    <footer className="status">
      <span className="path" title={path}>{path.split("/").pop()}{doc.history.isDirty ? " •" : ""}</span>
      <span>{doc.history.isDirty ? draft || "not saved" : path ? "saved" : ""}</span>
      {left ? <span className="wrong">{left}</span> : null}
      <button type="button" className={errors ? "wrong" : ""} onClick={() => doc.select([])}>{counts.length ? counts.join(", ") : path ? "no problems" : ""}</button>
      <span role="status" className="notice">{notice}</span>
    </footer>
  );
}

function Welcome({ ask }: { ask: Desk["ask"] }) {
  return (
    <div className="welcome">
      <p>Build a network of behaviors: what senses, what decides, what acts.</p>
      <p className="row"><button type="button" onClick={() => ask("new")}>New network</button><button type="button" onClick={() => ask("open")}>Open one</button></p>
    </div>
  );
}

interface MenuProps {
  id: string;
  x: number;
  y: number;
  doc: ComposerDocument;
  actions: Action[];
  showSchema(type: string): void;
}

function Menu({ id, x, y, doc, actions, showSchema }: MenuProps) {
  const place = useRef<HTMLDivElement>(null);
  const type = doc.network.behaviors.find((one) => one.id === id)?.type;
  useEffect(() => place.current?.querySelector("button")?.focus(), []);
  return (
    <div className="menu" role="menu" ref={place} style={{ left: x, top: y }}>
      {type ? <button type="button" role="menuitem" onClick={() => showSchema(type)}>Schema of {type}</button> : null}
      {actions.filter((one) => ["copy", "cut", "delete"].includes(one.id)).map((one) => <button key={one.id} type="button" role="menuitem" onClick={one.run}>{one.label}</button>)}
    </div>
  );
}

/** Whether an event is for the composer: it is shown, and no dialog is open. */
function isForUs(place: HTMLElement | null): boolean {
  return place !== null && !place.closest("[hidden]") && !document.querySelector("dialog[open]");
}

function isTyped(event: Event): boolean {
  const target = event.composedPath()[0] as HTMLElement;
  return target.matches?.("input, select, textarea, [contenteditable=true], [contenteditable=true] *") ?? false;
}

/** Keys work wherever no one types; with Ctrl also beside the fields of the properties. */
function useKeys(actions: Action[], place: { current: HTMLElement | null }): void {
  const newest = useRef(actions);
  newest.current = actions;
  useEffect(() => {
    const pressed = (event: KeyboardEvent) => {
      if (!isForUs(place.current)) return;
      const keys = keysOf(event);
      const action = newest.current.find((one) => one.keys.includes(keys));
      if (!action || action.isOfClipboard || (isTyped(event) && !["save", "save-as", "open"].includes(action.id))) return;
      event.preventDefault();
      event.stopPropagation();
      if (action.isPossible?.() ?? true) action.run();
    };
    addEventListener("keydown", pressed, true);
    return () => removeEventListener("keydown", pressed, true);
  }, [place]);
}

/** What the keys of the clipboard do: the browser hands it over, also from other tabs and programs. */
function useClipboard(doc: ComposerDocument, place: { current: HTMLElement | null }): void {
  useEffect(() => {
    const taken = (event: ClipboardEvent) => {
      if (!isForUs(place.current) || isTyped(event) || doc.path.value === "") return;
      if (event.type === "paste") {
        pasteText(doc, event.clipboardData?.getData("text/plain") ?? "");
      } else {
        if (String(getSelection()) !== "" || doc.history.error !== null || doc.selection.value.ids.size === 0) return;
        event.clipboardData?.setData("text/plain", copyChosen(doc));
        if (event.type === "cut") deleteChosen(doc);
      }
      event.preventDefault();
    };
    const types = ["copy", "cut", "paste"] as const;
    for (const type of types) document.addEventListener(type, taken);
    return () => {
      for (const type of types) document.removeEventListener(type, taken);
    };
  }, [doc, place]);
}

/** When a dialog has closed, the search for behaviors gets the focus if that was asked for, or if nothing else has it. */
function useFocusBack(isOpen: boolean): () => void {
  const isWanted = useRef(false);
  useEffect(() => {
    if (!isOpen) return;
    return () => {
      requestAnimationFrame(() => {
        if (document.querySelector("dialog[open]")) return;
        if (isWanted.current || document.activeElement === document.body) document.getElementById("palette-search")?.focus();
        isWanted.current = false;
      });
    };
  }, [isOpen]);
  return () => {
    isWanted.current = true;
  };
}

/** The other networks of an app, by name, while they are shown. */
function useOthers(app: string | null, path: string, files: server.NetworkFile[], doc: ComposerDocument): ReadonlyMap<string, Network> {
  const [others, setOthers] = useState<ReadonlyMap<string, Network>>(new Map());
  useEffect(() => {
    if (app === null) return setOthers(new Map());
    let isWanted = true;
    void doc.attempt(async () => {
      const found = files.filter((one) => one.app === app && one.path !== path);
      const read = await Promise.all(found.map(async (one): Promise<[string, Network]> => [one.name, readNetwork((await server.open(one.path)).text)]));
      if (isWanted) setOthers(new Map(read));
    });
    return () => {
      isWanted = false;
    };
  }, [app, path, files, doc]);
  return others;
}

function imagePorts(network: Network, palette: Parameters<typeof portsOf>[1], name: string): string[] {
  if (!name) return [];
  const ports = network.behaviors.flatMap(({ id }) =>
    portsOf(network, palette, id).outputs.filter((one) => one.datatype === "image").map((one) => `${name}/${id}.${one.name}`),
  );
  return ports.slice(0, MOST_THUMBNAILS);
}
