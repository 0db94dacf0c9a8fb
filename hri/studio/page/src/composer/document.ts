// The network that is open: its text and history, what is wrong with it, what is selected.

import { Autosave, type Open } from "./autosave";
import { History } from "./history";
import { EMPTY, readNetwork, type Link, type Network } from "./network";
import type { Splice } from "./edits";
import * as server from "./server";
import { Refusal, type Draft, type NetworkFile, type Problem } from "./server";
import { Store } from "./store";
import type { Unsaved } from "./unkept";
import type { Palette } from "./wiring";

const CHECK_AFTER_MS = 250;
const WATCH_EVERY_MS = 2000;
const NO_PALETTE: Palette = { mark: "", behaviors: [], aliases: {}, datatypes: {}, slots: [], devices: [], broken: [] };

export interface Selection {
  /** Ids of behaviors, and of slots of the board as `board.name`. */
  ids: ReadonlySet<string>;
  /** Links as `from -> to`. */
  links: ReadonlySet<string>;
}

/** A draft that a person may continue: of the server, or what only this browser has. */
export type Offer = Draft & { unkept?: Unsaved };

/** What a person has to decide. */
export type Question =
  | { kind: "drafts"; drafts: Offer[] }
  | { kind: "changed"; text: string; mark: string | null }
  | { kind: "unreadable"; why: string };

/** Networks that were left unsaved, of which undo is remembered. */
const MOST_LEFT = 10;

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
  /** Names this opening of the network: each has a draft of its own. */
  private page = newPage();
  /** Counts what was asked to be opened: the last is shown, whichever answer comes last. */
  private asked = 0;
  /** What was left with unsaved changes, by path. */
  private readonly left = new Map<string, History>();
  /** What was sent to be saved while no answer has come: the file may have it, or not. */
  private readonly unanswered = new Set<string>();
  private isAskingWorkshop = false;
  private checking: ReturnType<typeof setTimeout> | undefined;
  private watching: ReturnType<typeof setInterval> | undefined;
  private unfollow: () => void = () => {};

  constructor() {
    this.autosave = new Autosave(() => this.unsaved);
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

  /** Show a network, unless another is asked for meanwhile. Whether it, or that, is shown. */
  async open(path: string): Promise<boolean> {
    const asked = ++this.asked;
    if (path === this.path.value) return true;
    const isOpen = await this.attempt(async () => {
      await this.autosave.again();
      const file = await server.open(path).catch((error: unknown) => {
        if (asked === this.asked) throw error;
      });
      if (file === undefined || asked !== this.asked) return;
      this.take(path, file.text, file.mark, file.is_writable ? "" : file.why);
      if (file.damaged.length > 0) this.notice.set(file.damaged.join(", "));
      this.offer(file.drafts);
    });
    return isOpen;
  }

  /** A network that has no file yet: it is kept as a draft until it is saved. */
  create(path: string, text = EMPTY): void {
    this.asked++;
    this.take(path, text, null, "");
  }

  private take(path: string, text: string, mark: string | null, why: string): void {
    this.leave();
    this.unfollow();
    this.history = new History(text);
    this.page = newPage();
    this.mark = mark;
    this.unanswered.clear();
    this.why = why;
    this.question.set(null);
    this.autosave.state.set("");
    this.selection.set(NOTHING);
    this.problems.set([]);
    this.path.set(path);
    this.notice.set("");
    this.follow();
    this.changed();
  }

  /** Keep what is open: another takes its place. */
  private leave(): void {
    this.autosave.keep();
    const path = this.path.value;
    this.left.delete(path);
    if (this.history.isDirty) this.left.set(path, this.history);
    if (this.left.size > MOST_LEFT) this.left.delete(this.left.keys().next().value!);
  }

  /** Ask for each draft of what is open whether to go on with it. */
  private offer(drafts: Draft[]): void {
    const unkept = this.autosave.unkeptOf(this.path.value).map((one): Offer => ({ ...one, seen: "", unkept: one }));
    const kept = drafts.filter((one) => !unkept.some(({ page }) => page === one.page));
    const found = [...unkept, ...kept].filter((one) => one.text !== this.history.text).sort((a, b) => b.time - a.time);
    if (found.length > 0) this.question.set({ kind: "drafts", drafts: found });
  }

  /** What the autosave keeps. */
  private get unsaved(): Open | null {
    if (!this.path.value || this.question.value?.kind === "drafts") return null;
    const { page, mark, history } = this;
    return { page, path: this.path.value, text: history.isDirty ? history.text : null, mark, count: this.revision.value };
  }

  private follow(): void {
    this.unfollow = this.history.subscribe(() => this.changed());
  }

  private changed(): void {
    this.revision.set(this.revision.value + 1);
    this.autosave.changed();
    clearTimeout(this.checking);
    if (this.history.error !== null) {
      const { line, column, message } = this.history.error;
      this.problems.set([{ line, column, what: message, remedy: "fix the XML here", grave: "error", behavior: null, parameter: null, link: null }]);
    } else {
      this.checkSoon();
    }
  }

  private async check(): Promise<void> {
    const { revision } = this;
    const asked = revision.value;
    if (!this.path.value) return;
    if (this.isAskingWorkshop) return this.checkSoon();
    await this.askWorkshop(() =>
      this.attempt(async () => {
        const checked = await server.check(this.path.value, this.history.text);
        if (asked !== revision.value) return;
        this.problems.set(checked.problems);
        this.order.set(checked.order);
        if (checked.datatypes) this.palette.set({ ...this.palette.value, datatypes: checked.datatypes });
      }),
    );
    if (asked !== revision.value && this.history.error === null) this.checkSoon();
  }

  private checkSoon(): void {
    clearTimeout(this.checking);
    this.checking = setTimeout(() => void this.check(), CHECK_AFTER_MS);
  }

  /** One question at a time: a browser has six connections, and drafts must not wait for slow checks. */
  private async askWorkshop<T>(question: () => Promise<T>): Promise<T> {
    this.isAskingWorkshop = true;
    try {
      return await question();
    } finally {
      this.isAskingWorkshop = false;
    }
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

  /** Save it, and ask first where what cannot be read would replace what can. */
  async save(isSure = false): Promise<boolean> {
    if (this.why) {
      this.notice.set(`${this.why} - save it as another file`);
      return false;
    }
    const { error, savedText } = this.history;
    if (!isSure && error !== null && this.mark !== null && isReadable(savedText)) {
      this.question.set({ kind: "unreadable", why: error.message });
      return false;
    }
    const { page, history, mark } = this;
    const { text } = history;
    const path = this.path.value;
    const count = this.revision.value;
    return this.attempt(async () => {
      this.unanswered.add(text);
      try {
        const saved = await server.save(path, text, mark, page, count);
        history.markSaved(text);
        this.autosave.saved(page, text, count);
        if (page === this.page) this.known(text, saved.mark);
      } catch (error) {
        if (!(error instanceof Refusal) || page !== this.page) throw error;
        this.unanswered.delete(text);
        if (typeof error.answer.text !== "string") throw error;
        const [there, mark] = [error.answer.text, error.answer.mark as string | null];
        if (!this.isOurs(there, mark)) this.question.set({ kind: "changed", text: there, mark });
        else if (this.history.isDirty) await this.save(true);
        return;
      }
      this.notice.set(`saved ${path}`);
      void this.refreshFiles();
    });
  }

  /** The file has this text; what was typed since is still to be kept. */
  private known(text: string, mark: string | null): void {
    this.mark = mark;
    this.unanswered.clear();
    this.history.markSaved(text);
    this.revision.set(this.revision.value + 1);
    this.autosave.changed();
  }

  /** Whether a file that changed has what is here, or what was sent to be saved when the server ended. */
  private isOurs(text: string, mark: string | null): boolean {
    if (mark === null || (text !== this.history.text && !this.unanswered.has(text))) return false;
    this.known(text, mark);
    return true;
  }

  /** Raises Refusal. What is typed meanwhile is not saved, and stays. */
  async saveAs(to: string): Promise<string> {
    const { page, history } = this;
    const { text } = history;
    const count = this.revision.value;
    const { path } = await server.begin(to);
    const { mark } = await server.save(path, text, null, page, count);
    void this.refreshFiles();
    if (page !== this.page) return path;
    const before = this.path.value;
    this.asked++;
    this.page = newPage();
    this.path.set(path);
    this.why = "";
    this.autosave.saved(page, text, count);
    this.known(text, mark);
    this.notice.set(`saved ${path}`);
    await server.dropDraft(before, page).catch(() => {});
    return path;
  }

  /** Go on with a draft. It is dropped when what is open has a draft with its text. */
  continueDraft(draft: Offer): void {
    const rest = this.otherDrafts(draft);
    this.question.set(null);
    const left = this.left.get(this.path.value);
    if (left?.text === draft.text && left.savedText === this.history.text) {
      this.unfollow();
      this.history = left;
      this.follow();
      this.changed();
    } else {
      this.history.reset(draft.text, "continue the draft");
    }
    if (rest.length > 0) this.notice.set(`${rest.length === 1 ? "another draft is" : `${rest.length} other drafts are`} left, for the next time`);
    this.autosave.replaces(this.page, { ...draft, path: this.path.value });
  }

  async discardDraft(draft: Offer): Promise<void> {
    await this.attempt(async () => {
      await server.dropDraft(this.path.value, draft.page, draft.seen);
      if (draft.unkept) this.autosave.forget(draft.unkept);
      const rest = this.otherDrafts(draft);
      this.question.set(rest.length > 0 ? { kind: "drafts", drafts: rest } : null);
    });
  }

  private otherDrafts(draft: Offer): Offer[] {
    const question = this.question.value;
    return question?.kind === "drafts" ? question.drafts.filter((one) => one.page !== draft.page) : [];
  }

  /** Leave what is asked as it is: drafts stay, an unreadable text is not saved. */
  decideLater(): void {
    this.question.set(null);
  }

  /** Of a file that changed: go on with the text that is here, or take the other. Both can be undone. */
  chooseText(isOther: boolean): void {
    const question = this.question.value;
    if (question?.kind !== "changed") return;
    this.question.set(null);
    this.mark = question.mark;
    if (isOther) {
      this.history.reset(question.text, "take the file as it is now");
      this.history.markSaved();
    } else {
      this.history.markSaved(question.text);
    }
    this.revision.set(this.revision.value + 1);
    this.autosave.changed();
  }

  /** Whether the file was changed by someone else. */
  private async look(): Promise<void> {
    if (!this.path.value || this.question.value || (document.hidden && !this.history.isDirty)) return;
    const { page } = this;
    const found = await server.watch(this.path.value, this.mark, page).catch(() => null);
    if (found === null || page !== this.page || this.question.value) return;
    if (!found.has_draft) this.autosave.isMissing(page);
    if (found.text === undefined || found.mark === this.mark || this.isOurs(found.text, found.mark)) return;
    if (this.history.isDirty || found.mark === null) {
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
    if (this.isAskingWorkshop) return;
    const { mark } = this.palette.value;
    const found = await this.askWorkshop(() => server.palette(mark).catch(() => null));
    if (found === null) return;
    this.palette.set({ ...found, datatypes: this.palette.value.datatypes });
    if (mark !== "") this.notice.set("the behaviors on the configuration path changed");
    if (this.history.error === null) void this.check();
  }

  /** Do something that may be refused; the refusal is the notice. Whether it was done. */
  async attempt(work: () => Promise<unknown>): Promise<boolean> {
    try {
      await work();
      return true;
    } catch (error) {
      this.notice.set(reasonOf(error as Error));
      return false;
    }
  }
}

/** Why something was not done, for a person. */
export function reasonOf(error: Error): string {
  return error instanceof TypeError ? "no link to the robot" : error.message;
}

function newPage(): string {
  return [...crypto.getRandomValues(new Uint8Array(8))].map((one) => one.toString(16).padStart(2, "0")).join("");
}

function isReadable(text: string): boolean {
  try {
    readNetwork(text);
    return true;
  } catch {
    return false;
  }
}
