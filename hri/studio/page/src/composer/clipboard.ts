// Behaviors as text: what is copied is XML, and so is what is pasted, wherever it comes from.

import type { ComposerDocument } from "./document";
import { copy, paste, remove } from "./edits";
import { readNetwork, type Box } from "./network";

/** Between a copy and what it is of. */
const BESIDE: Box = { x: 30, y: 30 };
/** Letters. */
const LONGEST = 1_000_000;

/** What was copied here last, for a browser whose clipboard a button may not read. */
let copied = "";

export function copyChosen(doc: ComposerDocument): string {
  const { ids } = doc.selection.value;
  copied = copy(doc.network, [...ids]);
  doc.notice.set(`copied ${ids.size}`);
  return copied;
}

export function deleteChosen(doc: ComposerDocument): void {
  const { ids, links } = doc.selection.value;
  const cut = doc.network.links.filter((one) => links.has(`${one.from} -> ${one.to}`));
  doc.apply(remove(doc.network, [...ids], cut), ids.size === 1 ? `delete ${[...ids][0]}` : "delete what was selected");
  doc.select([]);
}

/** By a button: the browser may ask, or refuse. */
export async function copyByButton(doc: ComposerDocument): Promise<void> {
  const text = copyChosen(doc);
  await navigator.clipboard?.writeText(text).catch(() => {});
}

export async function pasteByButton(doc: ComposerDocument): Promise<void> {
  const read = await navigator.clipboard?.readText?.().catch(() => undefined);
  if (read === undefined && copied === "") doc.notice.set("the browser does not let a button read the clipboard - press Ctrl+V");
  else pasteText(doc, read ?? copied);
}

/** Paste a text that may have behaviors in it; one that has none is refused in the notice. */
export function pasteText(doc: ComposerDocument, text: string): void {
  if (doc.history.error !== null) return doc.notice.set("not pasted: the XML cannot be read - fix it first, or undo");
  const fragment = fragmentOf(text);
  if (fragment === null) return doc.notice.set("not pasted: no XML of behaviors is in the clipboard - copy behaviors first, or a text with <Behavior …>");
  try {
    const { splices, ids } = paste(doc.network, fragment, BESIDE);
    doc.apply(splices, ids.length === 1 ? `paste ${ids[0]}` : `paste ${ids.length} behaviors`);
    doc.select(ids);
    doc.notice.set(`pasted ${ids.length}`);
  } catch (error) {
    doc.notice.set(`not pasted: ${(error as Error).message}`);
  }
}

/** The network in a text such as a mail, with its quotation marks; null where there is none. */
export function fragmentOf(text: string): string | null {
  if (text.length > LONGEST) return null;
  const plain = text.replaceAll("\u00a0", " ").replace(/\r\n?/g, "\n");
  for (const one of [plain, plain.replace(/^(> ?)+/gm, "")]) {
    const whole = between(one, /<BehaviorNetwork\b/, ["</BehaviorNetwork>"]);
    const parts = between(one, /<(Behavior|Link)\b/, ["/>", "</Behavior>", "</Link>", "</Layout>"]);
    for (const found of [whole, `<BehaviorNetwork>${parts}</BehaviorNetwork>`]) if (isPasted(found)) return found;
  }
  return null;
}

/** From the first beginning to the last of the ends. */
function between(text: string, begin: RegExp, ends: readonly string[]): string {
  const from = text.search(begin);
  const to = Math.max(...ends.map((one) => text.lastIndexOf(one) + one.length));
  return from < 0 ? "" : text.slice(from, to);
}

/** Whether it can be read, and has behaviors. */
function isPasted(text: string): boolean {
  try {
    const { behaviors } = readNetwork(text);
    return behaviors.length > 0 && behaviors.every((one) => one.type !== "");
  } catch {
    return false;
  }
}
