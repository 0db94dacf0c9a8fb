// What has to be asked: which file, which text to go on with, what a schema says.

import { useEffect, useMemo, useRef, useState, type FormEvent, type ReactNode } from "react";
import { compare, type Difference } from "./difference";
import type { ComposerDocument, Question } from "./document";
import { EMPTY, readNetwork } from "./network";
import type { NetworkFile } from "./server";
import { useStore } from "./store";

interface DialogProps {
  title: string;
  close(): void;
  children: ReactNode;
}

export function Dialog({ title, close, children }: DialogProps) {
  const place = useRef<HTMLDialogElement>(null);
  useEffect(() => {
    const dialog = place.current!;
    dialog.showModal();
    return () => dialog.close();
  }, []);
  return (
    <dialog ref={place} className="composer-dialog" aria-label={title} onCancel={(event) => { event.preventDefault(); close(); }}>
      <h2>{title}</h2>
      {children}
    </dialog>
  );
}

export function OpenDialog({ doc, open, close }: { doc: ComposerDocument; open(path: string): void; close(): void }) {
  const { networks } = useStore(doc.files);
  const [words, setWords] = useState("");
  const found = networks.filter((one) => `${one.path} ${one.app ?? ""}`.toLowerCase().includes(words.toLowerCase()));
  useEffect(() => void doc.refreshFiles(), [doc]);
  return (
    <Dialog title="Open a network" close={close}>
      <input type="search" aria-label="Search networks" placeholder="Search" value={words} autoFocus onChange={(event) => setWords(event.target.value)} />
      <div className="files">
        {[...byFolder(found)].map(([folder, files]) => (
          <section key={folder}>
            <h3 title={folder}>{headingOf(files[0]!)}</h3>
            {files.map((one) => (
              <button key={one.path} type="button" onClick={() => { open(one.path); close(); }} title={one.path}>
                {one.name} {one.has_draft ? <small className="wrong">draft</small> : null} {one.is_writable ? null : <small>read only</small>}
              </button>
            ))}
          </section>
        ))}
        {found.length === 0 ? <p className="quiet">There is none with “{words}” in its name.</p> : null}
      </div>
      <p className="row"><button type="button" onClick={close}>Cancel</button></p>
    </Dialog>
  );
}

function byFolder(files: NetworkFile[]): Map<string, NetworkFile[]> {
  const groups = new Map<string, NetworkFile[]>();
  for (const one of files) groups.set(one.folder, [...(groups.get(one.folder) ?? []), one]);
  return groups;
}

function headingOf(file: NetworkFile): string {
  if (file.kind === "app") return `App ${file.app}`;
  return `${file.kind === "primitive" ? "Networks of tasks" : "Networks"} in ${file.folder}`;
}

interface NameProps {
  doc: ComposerDocument;
  title: string;
  remark: string;
  /** Why a path cannot be taken; empty when it can. */
  take(path: string): void;
  close(): void;
}

/** Asks for the path of a file that is not there yet. */
export function NameDialog({ doc, title, remark, take, close }: NameProps) {
  const { home, networks } = useStore(doc.files);
  const [text, setText] = useState("");
  const file = text.trim() === "" ? "" : text.trim().endsWith(".xml") ? text.trim() : `${text.trim()}.xml`;
  const path = file.startsWith("/") || file === "" ? file : `${home}/${file}`;
  const isThere = networks.some((one) => one.path === path);
  const submit = (event: FormEvent) => {
    event.preventDefault();
    if (path === "" || isThere) return;
    take(path);
    close();
  };
  return (
    <Dialog title={title} close={close}>
      <form onSubmit={submit}>
        <label htmlFor="network-name">Name or path</label>
        <input id="network-name" value={text} autoFocus autoComplete="off" spellCheck={false} placeholder="follow_me" onChange={(event) => setText(event.target.value)} />
        <p className={isThere ? "wrong" : "quiet"}>{isThere ? "There is one of this name - open it, or choose another" : path || remark}</p>
        <p className="row"><button type="submit" disabled={path === "" || isThere}>OK</button><button type="button" onClick={close}>Cancel</button></p>
      </form>
    </Dialog>
  );
}

export function QuestionDialog({ doc, question }: { doc: ComposerDocument; question: Question }) {
  const isDraft = question.kind === "draft";
  const [mine, other] = isDraft ? [question.text, question.draft.text] : [doc.history.text, question.text];
  const difference = useMemo(() => differenceOf(mine, other), [mine, other]);
  const isGone = !isDraft && question.mark === null;
  return (
    <Dialog title={isDraft ? "There is a draft that was not saved" : isGone ? "The file was removed" : "The file changed while you edited it"} close={() => void doc.choose(false)}>
      <p>
        {isDraft
          ? `The draft is from ${new Date(question.draft.time * 1000).toLocaleString()}. Beside the file, the draft has:`
          : isGone ? "Saving writes it again." : "Beside what you have here, the file now has:"}
      </p>
      {isGone ? null : <DifferenceList difference={difference} />}
      <p className="row">
        <button type="button" autoFocus onClick={() => void doc.choose(isDraft)}>{isDraft ? "Continue the draft" : "Keep what I have"}</button>
        {isGone ? null : <button type="button" onClick={() => void doc.choose(!isDraft)}>{isDraft ? "Discard the draft" : "Take the file"}</button>}
      </p>
      {isDraft ? null : <p className="quiet">Either can be undone.</p>}
    </Dialog>
  );
}

function differenceOf(old: string, next: string): Difference | string {
  try {
    return compare(readNetwork(old || EMPTY), readNetwork(next || EMPTY));
  } catch (error) {
    return `one of them cannot be read: ${(error as Error).message}`;
  }
}

function DifferenceList({ difference }: { difference: Difference | string }) {
  if (typeof difference === "string") return <p className="wrong">{difference}</p>;
  const rows: [string, string][] = [
    ...difference.attributes.map((one): [string, string] => ["changed", one]),
    ...difference.added.map((one): [string, string] => ["added", one]),
    ...difference.removed.map((one): [string, string] => ["removed", one]),
    ...difference.changed.map((one): [string, string] => ["changed", `${one.id}: ${one.what.join(", ")}`]),
    ...difference.links.added.map((one): [string, string] => ["added", `link ${one}`]),
    ...difference.links.removed.map((one): [string, string] => ["removed", `link ${one}`]),
  ];
  if (rows.length === 0) return <p>{difference.isSame ? "nothing else" : "only other places, order, comments, or spaces"}</p>;
  return <ul className="difference">{rows.map(([kind, words]) => <li key={`${kind} ${words}`} className={kind}><b>{kind}</b> {words}</li>)}</ul>;
}

export function TextDialog({ title, text, close }: { title: string; text: string; close(): void }) {
  return (
    <Dialog title={title} close={close}>
      <pre tabIndex={0}>{text}</pre>
      <p className="row"><button type="button" autoFocus onClick={close}>Close</button></p>
    </Dialog>
  );
}

interface BreakProps {
  port: string;
  condition: string;
  take(condition: string): void;
  close(): void;
}

export function BreakDialog({ port, condition, take, close }: BreakProps) {
  const [text, setText] = useState(condition);
  const submit = (event: FormEvent) => {
    event.preventDefault();
    take(text.trim());
    close();
  };
  return (
    <Dialog title={`Pause when ${port} …`} close={close}>
      <form onSubmit={submit}>
        <label htmlFor="condition">Condition</label>
        <input id="condition" value={text} autoFocus autoComplete="off" spellCheck={false} placeholder="< 30" onChange={(event) => setText(event.target.value)} />
        <p className="quiet">&lt; 30, &gt;= 0.5, == true, == hello, changes, or sent. The network pauses after the tick in which it holds; its drive gets zero.</p>
        <p className="row"><button type="submit">Set</button><button type="button" onClick={() => { take(""); close(); }}>Remove</button><button type="button" onClick={close}>Cancel</button></p>
      </form>
    </Dialog>
  );
}
