// The text of a network with all that was done to it. Undo puts back the very bytes.

import { applySplices, inverse, stretch, type Splice } from "./edits";
import { readNetwork, type Network } from "./network";
import { XmlError } from "./xml";

interface Step {
  label: string;
  merge: string;
  /** From the text after the step to the one before, splices by splices. */
  back: Splice[][];
  forth: Splice[][];
}

export class History {
  text: string;
  network: Network | null = null;
  error: XmlError | null = null;
  /** Counts all changes of the text. */
  revision = 0;
  private done: Step[] = [];
  private undone: Step[] = [];
  private saved: string;
  private readonly followers = new Set<() => void>();

  constructor(text: string) {
    this.text = this.saved = text;
    this.read();
  }

  /** One command; one of the same `merge` as the last is joined with it. Whether it changed anything. */
  apply(splices: readonly Splice[], label: string, merge = ""): boolean {
    const text = applySplices(this.text, splices);
    if (text === this.text) return false;
    const back = inverse(this.text, splices);
    const last = this.done.at(-1);
    if (merge !== "" && last?.merge === merge && this.undone.length === 0) {
      last.back.unshift(back);
      last.forth.push([...splices]);
    } else {
      this.done.push({ label, merge, back: [back], forth: [[...splices]] });
    }
    this.undone = [];
    this.set(text);
    return true;
  }

  /** Another text; this can be undone, too. */
  reset(text: string, label: string): void {
    this.apply([stretch(this.text, text)], label);
  }

  /** What was undone; null when there is nothing. */
  undo(): string | null {
    return this.walk(this.done, this.undone, "back");
  }

  redo(): string | null {
    return this.walk(this.undone, this.done, "forth");
  }

  private walk(from: Step[], to: Step[], way: "back" | "forth"): string | null {
    const step = from.pop();
    if (step === undefined) return null;
    to.push(step);
    this.set(step[way].reduce(applySplices, this.text));
    return step.label;
  }

  get undoLabel(): string | null {
    return this.done.at(-1)?.label ?? null;
  }

  get redoLabel(): string | null {
    return this.undone.at(-1)?.label ?? null;
  }

  /** The file has this text: the one there is now, or one from before. */
  markSaved(text = this.text): void {
    this.saved = text;
    // What comes now is not joined with what is saved.
    const last = this.done.at(-1);
    if (last) last.merge = "";
  }

  get isDirty(): boolean {
    return this.text !== this.saved;
  }

  /** What the file has. */
  get savedText(): string {
    return this.saved;
  }

  subscribe(follower: () => void): () => void {
    this.followers.add(follower);
    return () => this.followers.delete(follower);
  }

  private set(text: string): void {
    this.text = text;
    this.revision++;
    this.read();
    for (const follower of [...this.followers]) follower();
  }

  private read(): void {
    try {
      this.network = readNetwork(this.text);
      this.error = null;
    } catch (error) {
      if (!(error instanceof XmlError)) throw error;
      this.network = null;
      this.error = error;
    }
  }
}
