// Keeps a draft of what is not saved: at most two seconds of editing can be lost.

import { dropDraft, keepDraft } from "./server";
import { Store } from "./store";

/** Between an edit and its draft; the way to the server and its disk come on top. */
export const DRAFT_AFTER_MS = 600;
/** Until a draft that failed is tried again. */
const AGAIN_AFTER_MS = 700;

/** What is to be kept now. */
export interface Unsaved {
  path: string;
  text: string;
  mark: string | null;
}

export class Autosave {
  /** What the status bar says of it. */
  readonly state = new Store("");
  private timer: ReturnType<typeof setTimeout> | undefined;
  private isSending = false;
  private kept = "";

  /** `unsaved` gives what differs from the file, or null. */
  constructor(private readonly unsaved: () => Unsaved | null) {
    // The last moment before the page goes; a browser that is killed has the draft from before.
    addEventListener("pagehide", () => void this.keep(true));
    document.addEventListener("visibilitychange", () => document.hidden && void this.keep(true));
  }

  /** Something changed. */
  changed(): void {
    this.timer ??= setTimeout(() => void this.keep(), DRAFT_AFTER_MS);
  }

  /** The file has it now, or it is not wanted anymore. */
  forget(): void {
    clearTimeout(this.timer);
    this.timer = undefined;
    this.kept = "";
    this.state.set("");
  }

  /** Forget the draft on the server, too. */
  async drop(path: string): Promise<void> {
    this.forget();
    await dropDraft(path);
  }

  private async keep(isLast = false): Promise<void> {
    clearTimeout(this.timer);
    this.timer = undefined;
    const found = this.unsaved();
    if (found === null || (found.text === this.kept && !this.isSending)) return;
    if (this.isSending && !isLast) return this.changed();
    this.isSending = true;
    try {
      // A request that outlives its page takes at most 64 kB.
      await keepDraft(found.path, found.text, found.mark, isLast && found.text.length < 60_000);
      this.kept = found.text;
      this.state.set(`draft kept at ${new Date().toLocaleTimeString()}`);
    } catch (error) {
      this.state.set(`no draft is kept - ${error instanceof TypeError ? "no link to the robot" : (error as Error).message}`);
      this.timer ??= setTimeout(() => void this.keep(), AGAIN_AFTER_MS);
    } finally {
      this.isSending = false;
    }
  }
}
