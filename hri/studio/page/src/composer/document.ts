// The network that is open: its text and history, what is wrong with it, what is selected.

import { Autosave } from "./autosave";
import { History } from "./history";
import { EMPTY, type Link, type Network } from "./network";
import type { Splice } from "./edits";
import * as server from "./server";
import { Refusal, type Draft, type NetworkFile, type Problem } from "./server";
import { Store } from "./store";
import type { Palette } from "./wiring";

const CHECK_AFTER_MS = 250;
const WATCH_EVERY_MS = 2000;
const NO_PALETTE: Palette = { mark: "", behaviors: [], aliases: {}, slots: [], devices: [], broken: [] };

export interface Selection {
  /** Ids of behaviors, and of slots of the board as `board.name`. */
  ids: ReadonlySet<string>;
  /** Links as `from -> to`. */
  links: ReadonlySet<string>;
}

/** What a person has to decide. */
export type Question =
  | { kind: "draft"; draft: Draft; text: string }
  | { kind: "changed"; text: string; mark: string | null };

const NOTHING: Selection = { ids: new Set(), links: new Set() };

export function linkKey(link: Pick<Link, "from" | "to">): string {
  return `${link.from} -> ${link.to}`;
}

export class ComposerDocument {
  readonly path = new Store<string>("");
  /** Counts all changes of the text; who follows it reads `history`. */
  readonly revision = new Store(0);
  readonly selection = new Store<Selection>(NOTHING);
  readonly problems = new Store<Problem[]>([]);
  readonly order = new Store<string[]>([]);
  readonly palette = new Store<Palette>(NO_PALETTE);
  readonly question = new Store<Question | null>(null);
  readonly files = new Store<{ networks: NetworkFile[]; home: string }>({ networks: [], home: "" });
  /** What the status bar says. */
  readonly notice = new Store("");
  readonly autosave: Autosave;
  history = new History(EMPTY);
  /** Why it cannot be saved here; empty when it can. */
  why = "";
  private mark: string | null = null;
  /** What was sent to be saved while no answer has come: the file may have it, or not. */
  private readonly unanswered = new Set<string>();
  private checking: ReturnType<typeof setTimeout> | undefined;
  private watching: ReturnType<typeof setInterval> | undefined;
  private unfollow: () => void = () => {};

  constructor() {
    this.autosave = new Autosave(() =>
      this.path.value && this.history.isDirty && this.question.value?.kind !== "draft"
        ? { path: this.path.value, text: this.history.text, mark: this.mark }
        : null,
    );
    this.follow();
  }

  /** The network as it is, or as it last was while its text cannot be read. */
  get network(): Network {
    const network = this.history.network;
    if (network !== null) this.readable = network;
    return this.readable;
  }

  private readable: Network = new History(EMPTY).network!;

  /** Begin to look at files and palette. */
  begin(): void {
    void this.refreshPalette();
    void this.refreshFiles();
    this.watching ??= setInterval(() => {
      void this.refreshPalette();
      void this.look();
    }, WATCH_EVERY_MS);
  }

  end(): void {
    clearInterval(this.watching);
    this.watching = undefined;
  }

  async open(path: string): Promise<void> {
    await this.attempt(async () => {
      const file = await server.open(path);
      this.take(path, file.text, file.mark, file.is_writable ? "" : file.why);
      if (file.draft !== null && file.draft.text !== file.text)
        this.question.set({ kind: "draft", draft: file.draft, text: file.text });
    });
  }

  /** A network that has no file yet: it is kept as a draft until it is saved. */
  create(path: string, text = EMPTY): void {
    this.take(path, text, null, "");
  }

  private take(path: string, text: string, mark: string | null, why: string): void {
    this.unfollow();
    this.history = new History(text);
    this.mark = mark;
    this.unanswered.clear();
    this.why = why;
    this.question.set(null);
    this.autosave.forget();
    this.selection.set(NOTHING);
    this.problems.set([]);
    this.path.set(path);
    this.notice.set("");
    this.follow();
    this.changed();
  }

  private follow(): void {
    this.unfollow = this.history.subscribe(() => this.changed());
  }

  private changed(): void {
    this.revision.set(this.revision.value + 1);
    if (this.history.isDirty) this.autosave.changed();
    clearTimeout(this.checking);
    if (this.history.error !== null) {
      const { line, column, message } = this.history.error;
      this.problems.set([{ line, column, what: message, remedy: "fix the XML here", grave: "error", behavior: null, parameter: null, link: null }]);
    } else {
      this.checking = setTimeout(() => void this.check(), CHECK_AFTER_MS);
    }
  }

  private async check(): Promise<void> {
    const { revision } = this;
    const asked = revision.value;
    if (!this.path.value) return;
    await this.attempt(async () => {
      const checked = await server.check(this.path.value, this.history.text);
      if (asked !== revision.value) return;
      this.problems.set(checked.problems);
      this.order.set(checked.order);
    });
  }

  /** One command: a change of the text that can be undone. */
  apply(splices: Splice[], label: string, merge = ""): void {
    if (splices.length > 0) this.history.apply(splices, label, merge);
  }

  undo(): void {
    const label = this.history.undo();
    this.notice.set(label === null ? "nothing to undo" : `undone: ${label}`);
  }

  redo(): void {
    const label = this.history.redo();
    this.notice.set(label === null ? "nothing to redo" : `done again: ${label}`);
  }

  select(ids: Iterable<string>, links: Iterable<string> = []): void {
    const next = { ids: new Set(ids), links: new Set(links) };
    const { ids: had, links: hadLinks } = this.selection.value;
    const isSame = (a: ReadonlySet<string>, b: ReadonlySet<string>) => a.size === b.size && [...a].every((one) => b.has(one));
    if (!isSame(next.ids, had) || !isSame(next.links, hadLinks)) this.selection.set(next);
  }

  /** Whether it is saved now. */
  async save(): Promise<boolean> {
    if (this.why) {
      this.notice.set(`${this.why} - save it as another file`);
      return false;
    }
    const { text } = this.history;
    return this.attempt(async () => {
      this.unanswered.add(text);
      try {
        this.known(text, (await server.save(this.path.value, text, this.mark)).mark);
      } catch (error) {
        if (!(error instanceof Refusal)) throw error;
        this.unanswered.delete(text);
        if (typeof error.answer.text !== "string") throw error;
        if (this.isOurs(error.answer.text, error.answer.mark as string | null)) {
          await this.save();
          return;
        }
        this.question.set({ kind: "changed", text: error.answer.text, mark: error.answer.mark as string | null });
        return;
      }
      this.notice.set(`saved ${this.path.value}`);
      void this.refreshFiles();
    });
  }

  /** The file has this text; what was typed since is still to be kept. */
  private known(text: string, mark: string | null): void {
    this.mark = mark;
    this.unanswered.clear();
    this.history.markSaved(text);
    if (!this.history.isDirty) this.autosave.forget();
    this.revision.set(this.revision.value + 1);
  }

  /** Whether a file that changed has what was saved here when the server ended: then it is known. */
  private isOurs(text: string, mark: string | null): boolean {
    if (!this.unanswered.has(text)) return false;
    this.known(text, mark);
    return true;
  }

  async saveAs(path: string): Promise<boolean> {
    const { text } = this.history;
    const before = this.path.value;
    return this.attempt(async () => {
      const { mark } = await server.save(path, text, null);
      if (before && this.history.isDirty) await server.dropDraft(before).catch(() => {});
      this.take(path, text, mark, "");
      this.notice.set(`saved ${path}`);
      void this.refreshFiles();
    });
  }

  /** Answer a question: go on with the text that is here, or take the other. */
  async choose(isOther: boolean): Promise<void> {
    const question = this.question.value;
    if (question === null) return;
    this.question.set(null);
    if (question.kind === "draft") {
      if (isOther) this.history.reset(question.draft.text, "continue the draft");
      else await this.attempt(() => this.autosave.drop(this.path.value));
      return;
    }
    this.mark = question.mark;
    if (isOther) {
      this.history.reset(question.text, "take the file as it is now");
      this.history.markSaved();
      await this.attempt(() => this.autosave.drop(this.path.value));
    } else {
      this.autosave.changed();
    }
    this.revision.set(this.revision.value + 1);
  }

  /** Whether the file was changed by someone else. */
  private async look(): Promise<void> {
    if (!this.path.value || this.question.value || document.hidden || this.mark === null) return;
    const path = this.path.value;
    const found = await server.watch(path, this.mark).catch(() => null);
    if (found === null || found.text === undefined || path !== this.path.value || found.mark === this.mark) return;
    if (this.isOurs(found.text, found.mark)) return;
    if (this.history.isDirty) {
      this.question.set({ kind: "changed", text: found.text, mark: found.mark });
      return;
    }
    this.mark = found.mark;
    this.history.reset(found.text, "the file changed outside");
    this.history.markSaved();
    this.revision.set(this.revision.value + 1);
    this.notice.set("the file was changed outside - this is how it is now");
  }

  async refreshFiles(): Promise<void> {
    const found = await server.networks().catch(() => null);
    if (found !== null) this.files.set(found);
  }

  private async refreshPalette(): Promise<void> {
    const found = await server.palette(this.palette.value.mark).catch(() => null);
    if (found === null) return;
    const isFirst = this.palette.value.mark === "";
    this.palette.set(found);
    if (!isFirst) this.notice.set("the behaviors on the configuration path changed");
    if (this.history.error === null) void this.check();
  }

  /** Do something that may be refused; the refusal is the notice. Whether it was done. */
  async attempt(work: () => Promise<unknown>): Promise<boolean> {
    try {
      await work();
      return true;
    } catch (error) {
      this.notice.set(error instanceof TypeError ? "no link to the robot" : (error as Error).message);
      return false;
    }
  }
}
