// Keeps drafts of what is not saved: at most two seconds of editing can be lost.

import * as server from "./server";
import { Refusal } from "./server";
import { Store } from "./store";
import { Unkept, type Unsaved } from "./unkept";

/** Between an edit and its draft; the way to the server and its disk come on top. */
export const DRAFT_AFTER_MS = 600;
/** Until a draft that failed is tried again. */
const AGAIN_AFTER_MS = 700;

/** What is open: its text, or null for one that needs no draft. */
export type Open = Omit<Unsaved, "text" | "time"> & { text: string | null };

interface Drafts {
  keep(one: Unsaved, isLast: boolean): Promise<unknown>;
  drop(path: string, page: string, seen?: string): Promise<unknown>;
}

/** A draft that a person continues in another page. */
export interface Replaced {
  path: string;
  page: string;
  seen: string;
  unkept?: Unsaved;
}

export class Autosave {
  /** What the status bar says of what is open. */
  readonly state = new Store("");
  /** What it says of networks that were left and are not kept. */
  readonly left = new Store("");
  /** What is to be kept, by page. */
  private readonly waiting = new Map<string, Unsaved>();
  /** The text of the draft that the server has, by page. */
  private readonly kept = new Map<string, string>();
  /** What is dropped as soon as a page has a draft of its own. */
  private readonly replaced = new Map<string, Replaced>();
  private timer: ReturnType<typeof setTimeout> | undefined;
  private isSending = false;
  private isFailing = false;

  /** `open` gives what is open; null while nothing is, or while a person has to choose a text. */
  constructor(
    private readonly open: () => Open | null,
    private readonly unkept = new Unkept(() => localStorage),
    private readonly drafts: Drafts = { keep: server.keepDraft, drop: server.dropDraft },
  ) {}

  /** Keep what there is when the page is left, hidden, or closed. */
  follow(page: Window): void {
    // The last moment before the page goes; a browser that is killed has the draft from before.
    page.addEventListener("pagehide", () => this.last());
    page.addEventListener("pageshow", () => this.keep());
    page.document.addEventListener("visibilitychange", () => page.document.hidden && this.keep());
    page.addEventListener("beforeunload", (event) => {
      this.collect();
      if (this.isFailing && this.waiting.size > 0) event.preventDefault();
    });
  }

  /** Something changed. */
  changed(): void {
    this.timer ??= setTimeout(() => this.keep(), DRAFT_AFTER_MS);
  }

  /** Keep what is open now, in the background: another network takes its place, or may soon. */
  keep(): void {
    clearTimeout(this.timer);
    this.timer = undefined;
    this.collect();
    void this.send();
  }

  /** The server says that a draft is not there, though it was kept. */
  isMissing(page: string): void {
    if (this.kept.delete(page)) this.changed();
  }

  /** What a page has is another draft, continued. */
  replaces(page: string, draft: Replaced): void {
    this.replaced.set(page, draft);
    this.keep();
  }

  /** A page was saved: the server has dropped its draft, unless that is later. */
  saved(page: string, text: string, count: number): void {
    if (this.kept.get(page) === text) this.kept.delete(page);
    const waits = this.waiting.get(page);
    if (waits !== undefined && waits.count <= count) this.waiting.delete(page);
    this.unkept.drop({ page, count });
    this.keep();
  }

  /** Give the server what pages that are closed could not give it. */
  async again(): Promise<void> {
    for (const one of this.unkept.all().filter(({ page }) => !this.waiting.has(page))) {
      try {
        await this.drafts.keep(one, false);
        this.unkept.drop(one);
      } catch (error) {
        if (!(error instanceof Refusal)) return; // there is no link
      }
    }
  }

  /** What is not saved of a network and has no draft on the server. */
  unkeptOf(path: string): Unsaved[] {
    const found = new Map([...this.unkept.all().map((one): [string, Unsaved] => [one.page, one]), ...this.waiting]);
    return [...found.values()].filter((one) => one.path === path);
  }

  /** A person does not want it. */
  forget(one: Unsaved): void {
    this.waiting.delete(one.page);
    this.unkept.drop(one);
  }

  /** Whether the draft of a page is this text. */
  isKept(page: string, text: string): boolean {
    return this.kept.get(page) === text;
  }

  private collect(): void {
    const open = this.open();
    if (open === null) return;
    const { text } = open;
    if (text === null || text === this.kept.get(open.page)) {
      const waits = this.waiting.get(open.page);
      if (waits !== undefined) this.forget({ ...waits, count: open.count });
    } else if (text !== this.waiting.get(open.page)?.text) {
      this.waiting.set(open.page, { ...open, text, time: Date.now() / 1e3 });
    }
  }

  private last(): void {
    this.collect();
    for (const one of this.waiting.values()) {
      this.unkept.put(one);
      void this.drafts.keep(one, true).catch(() => {});
    }
  }

  private async send(): Promise<void> {
    if (this.isSending) return;
    this.isSending = true;
    const refused = new Map<Unsaved, string>();
    try {
      for (let next = this.next(refused); next !== undefined; next = this.next(refused)) {
        try {
          await this.drafts.keep(next, false);
          this.kept.set(next.page, next.text);
          if (this.waiting.get(next.page) === next) this.waiting.delete(next.page);
          this.unkept.drop(next);
          await this.dropReplaced(next.page);
        } catch (error) {
          refused.set(next, `${error instanceof Refusal ? error.message : "no link to the robot"}${this.unkept.put(next) ? "; this browser has it" : ""}`);
        }
      }
      await this.dropNeedless();
    } finally {
      this.isSending = false;
      this.isFailing = refused.size > 0;
      this.tell(refused);
      if (this.isFailing) this.timer ??= setTimeout(() => this.keep(), AGAIN_AFTER_MS);
      else if (this.waiting.size > 0) this.changed();
    }
  }

  private async dropReplaced(page: string): Promise<void> {
    const old = this.replaced.get(page);
    if (old === undefined) return;
    this.replaced.delete(page);
    if (old.unkept) this.forget(old.unkept);
    await this.drafts.drop(old.path, old.page, old.seen).catch(() => {}); // it is offered once more
  }

  private next(refused: ReadonlyMap<Unsaved, string>): Unsaved | undefined {
    return [...this.waiting.values()].find((one) => !refused.has(one));
  }

  /** What is open is saved, or as it was: its draft is of no use. */
  private async dropNeedless(): Promise<void> {
    const open = this.open();
    if (open === null || open.text !== null || !this.kept.has(open.page)) return;
    const isDropped = await this.drafts.drop(open.path, open.page).then(() => true, () => false);
    if (isDropped) this.kept.delete(open.page);
    else this.timer ??= setTimeout(() => this.keep(), AGAIN_AFTER_MS);
    if (this.open()?.text !== null) this.changed(); // edited meanwhile: the draft may have gone with it
  }

  private tell(refused: ReadonlyMap<Unsaved, string>): void {
    const open = this.open();
    const others: string[] = [];
    let words = open?.text != null && this.isKept(open.page, open.text) ? `draft kept at ${new Date().toLocaleTimeString()}` : "";
    for (const [one, why] of refused) {
      if (one.page === open?.page) words = `no draft is kept - ${why}`;
      else others.push(`${one.path.split("/").pop()}: no draft is kept - ${why}`);
    }
    if (words || open?.text == null) this.state.set(words);
    this.left.set(others.join(", "));
  }
}
