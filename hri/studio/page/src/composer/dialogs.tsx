// What has to be asked: which file, which text to go on with, what a schema says.

import { useEffect, useLayoutEffect, useMemo, useRef, useState, type FormEvent, type ReactNode } from "react";
import { show } from "../dialog";
import { compare, type Difference } from "./difference";
import { reasonOf, type ComposerDocument, type Offer, type Question } from "./document";
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
  useLayoutEffect(() => show(place.current!), []);
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
  /** Raises Error with the reason why a path cannot be taken; returns nothing where that is known. */
  take(path: string): Promise<void> | void;
  close(): void;
}

/** Asks for the path of a file that is not there yet; stays open while it is refused. */
export function NameDialog({ doc, title, remark, take, close }: NameProps) {
  const { home } = useStore(doc.files);
  const [text, setText] = useState("");
  const { refusal, isBusy, attempt, forget } = useRefusal(close);
  const file = text.trim() === "" ? "" : text.trim().endsWith(".xml") ? text.trim() : `${text.trim()}.xml`;
  const path = file.startsWith("/") || file === "" ? file : `${home}/${file}`;
  const submit = (event: FormEvent) => {
    event.preventDefault();
    if (path !== "") attempt(() => take(path));
  };
  return (
    <Dialog title={title} close={close}>
      <form onSubmit={submit}>
        <label htmlFor="network-name">Name or path</label>
        <input id="network-name" value={text} readOnly={isBusy} autoFocus autoComplete="off" spellCheck={false} placeholder="follow_me" aria-describedby="network-name-remark" onChange={(event) => { setText(event.target.value); forget(); }} />
        <p id="network-name-remark" role="status" className={refusal ? "wrong" : "quiet"}>{refusal || path || remark}</p>
        <p className="row"><button type="submit" disabled={path === ""}>OK</button><button type="button" onClick={close}>Cancel</button></p>
      </form>
    </Dialog>
  );
}

/** Work that closes a dialog when it is done, and leaves it with the reason when it is refused. */
function useRefusal(close: () => void) {
  const [refusal, setRefusal] = useState("");
  const [isBusy, setBusy] = useState(false);
  const refused = (error: Error) => {
    setBusy(false);
    setRefusal(reasonOf(error));
  };
  const attempt = (work: () => Promise<void> | void) => {
    if (isBusy) return;
    const done = work();
    if (done === undefined) return close();
    setBusy(true);
    void done.then(close, refused);
  };
  return { refusal, isBusy, attempt, forget: () => setRefusal("") };
}

export function QuestionDialog({ doc, question }: { doc: ComposerDocument; question: Question }) {
  if (question.kind === "drafts") return <DraftsDialog doc={doc} drafts={question.drafts} />;
  if (question.kind === "changed") return <ChangedDialog doc={doc} text={question.text} isGone={question.mark === null} />;
  return (
    <Dialog title="Save what cannot be read?" close={() => doc.decideLater()}>
      <p>The XML cannot be read: {question.why}. The file on the disk can.</p>
      <p className="row">
        <button type="button" autoFocus onClick={() => doc.decideLater()}>Go on editing</button>
        <button type="button" onClick={() => { doc.decideLater(); void doc.save(true); }}>Save it anyway</button>
      </p>
    </Dialog>
  );
}

/** What was not saved, newest first; none goes unless a person discards it. */
function DraftsDialog({ doc, drafts }: { doc: ComposerDocument; drafts: Offer[] }) {
  const isOne = drafts.length === 1;
  return (
    <Dialog title={isOne ? "There is a draft that was not saved" : `There are ${drafts.length} drafts that were not saved`} close={() => doc.decideLater()}>
      {drafts.map((draft, number) => (
        <section key={draft.page} className="draft">
          <p>{isOne ? "The draft" : number === 0 ? "The newest" : "One"} is from {new Date(draft.time * 1000).toLocaleString()}{draft.unkept ? ", in this browser alone" : ""}. Beside the file, it has:</p>
          <DifferenceOf old={doc.history.text} next={draft.text} />
          <p className="row">
            <button type="button" autoFocus={number === 0} onClick={() => doc.continueDraft(draft)}>Continue the draft</button>
            <button type="button" onClick={() => void doc.discardDraft(draft)}>Discard the draft</button>
          </p>
        </section>
      ))}
      <p className="row"><button type="button" onClick={() => doc.decideLater()}>Decide later</button></p>
      <p className="quiet">A draft may be of another tab that is open. What you do not discard is offered again.</p>
    </Dialog>
  );
}

function ChangedDialog({ doc, text, isGone }: { doc: ComposerDocument; text: string; isGone: boolean }) {
  return (
    <Dialog title={isGone ? "The file was removed" : "The file changed while you edited it"} close={() => doc.chooseText(false)}>
      <p>{isGone ? "Saving writes it again." : "Beside what you have here, the file now has:"}</p>
      {isGone ? null : <DifferenceOf old={doc.history.text} next={text} />}
      <p className="row">
        <button type="button" autoFocus onClick={() => doc.chooseText(false)}>Keep what I have</button>
        {isGone ? null : <button type="button" onClick={() => doc.chooseText(true)}>Take the file</button>}
      </p>
      <p className="quiet">Either can be undone.</p>
    </Dialog>
  );
}

function DifferenceOf({ old, next }: { old: string; next: string }) {
  return <DifferenceList difference={useMemo(() => differenceOf(old, next), [old, next])} />;
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
  /** Raises Error with the reason why a condition cannot be taken. */
  take(condition: string): Promise<void>;
  close(): void;
}

export function BreakDialog({ port, condition, take, close }: BreakProps) {
  const [text, setText] = useState(condition);
  const { refusal, isBusy, attempt, forget } = useRefusal(close);
  const submit = (event: FormEvent) => {
    event.preventDefault();
    attempt(() => take(text.trim()));
  };
  return (
    <Dialog title={`Pause when ${port} …`} close={close}>
      <form onSubmit={submit}>
        <label htmlFor="condition">Condition</label>
        <input id="condition" value={text} readOnly={isBusy} autoFocus autoComplete="off" spellCheck={false} placeholder="< 30" aria-invalid={refusal !== ""} aria-describedby="condition-refusal" onChange={(event) => { setText(event.target.value); forget(); }} />
        <p id="condition-refusal" role="status" className="wrong">{refusal}</p>
        <p className="quiet">&lt; 30, &gt;= 0.5, == true, == hello, changes, or sent. The network pauses after the tick in which it holds; its drive gets zero.</p>
        <p className="row"><button type="submit">Set</button><button type="button" onClick={() => attempt(() => take(""))}>Remove</button><button type="button" onClick={close}>Cancel</button></p>
      </form>
    </Dialog>
  );
}
