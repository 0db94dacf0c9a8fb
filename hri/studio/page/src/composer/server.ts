// What the page asks of the server about networks: files, drafts, what is wrong, what there is.

import type { Unsaved } from "./unkept";
import type { Palette } from "./wiring";

export interface NetworkFile {
  path: string;
  name: string;
  folder: string;
  app: string | null;
  kind: "network" | "app" | "primitive";
  is_writable: boolean;
  has_draft: boolean;
}

export interface Draft {
  /** The opening of the network that it is of. */
  page: string;
  text: string;
  /** Of the file that the draft began from; null where there was none. */
  mark: string | null;
  /** Seconds since 1970. */
  time: number;
  /** By which this text is discarded, and no later one. */
  seen: string;
}

export interface OpenedFile {
  path: string;
  text: string;
  mark: string | null;
  is_writable: boolean;
  why: string;
  /** Newest first. */
  drafts: Draft[];
  /** What is wrong with drafts that cannot be read. */
  damaged: string[];
}

export interface Problem {
  line: number;
  column: number;
  what: string;
  remedy: string;
  grave: "error" | "warning";
  behavior: string | null;
  parameter: string | null;
  link: { from: string; to: string } | null;
}

export interface Checked {
  problems: Problem[];
  /** The ids of the behaviors in the order in which they run. */
  order: string[];
  /** Of outputs as `id.output` whose parameters decide them; null while the text cannot be read. */
  datatypes: Record<string, string> | null;
}

/** What the server refuses. */
export class Refusal extends Error {
  constructor(
    message: string,
    readonly status: number,
    readonly answer: Record<string, unknown>,
  ) {
    super(message);
  }
}

const ROOT = "/api/v1/networks";
/** Until a draft counts as not kept: a server that hangs must not keep edits waiting. */
const DRAFT_WITHIN_MS = 1400;
/** Bytes of a request that may outlive its page. */
const MOST_LAST = 60_000;

async function answer<T>(path: string, method = "GET", body?: unknown, more: RequestInit = {}): Promise<T> {
  const response = await fetch(ROOT + path, {
    method,
    ...(body === undefined ? {} : { body: JSON.stringify(body), headers: { "content-type": "application/json" } }),
    ...more,
  });
  const told = (await response.json()) as Record<string, unknown>;
  if (!response.ok) throw new Refusal(String(told.error ?? response.statusText), response.status, told);
  return told as T;
}

const at = (path: string) => `path=${encodeURIComponent(path)}`;

export const networks = () => answer<{ networks: NetworkFile[]; home: string }>("");
export const open = (path: string) => answer<OpenedFile>(`/file?${at(path)}`);
export const begin = (path: string) => answer<{ path: string }>(`/new?${at(path)}`);
export const save = (path: string, text: string, mark: string | null, page: string, count: number) =>
  answer<{ mark: string }>("/file", "PUT", { path, text, mark, page, count: String(count) });

export function keepDraft({ page, path, text, mark, count }: Unsaved, isLast: boolean): Promise<object> {
  const body = { page, path, text, mark, count: String(count) };
  const isShort = new TextEncoder().encode(JSON.stringify(body)).length < MOST_LAST;
  return answer<object>("/draft", "PUT", body, isLast ? { keepalive: isShort } : { signal: AbortSignal.timeout(DRAFT_WITHIN_MS) });
}

export const dropDraft = (path: string, page: string, seen = "") => answer<object>(`/draft?${at(path)}&page=${page}&seen=${seen}`, "DELETE");
export const watch = (path: string, mark: string | null, page: string) =>
  answer<{ mark: string | null; text?: string; has_draft: boolean }>(`/watch?${at(path)}&mark=${mark ?? ""}&page=${page}`);
export const check = (path: string, text: string) => answer<Checked>("/check", "POST", { path, text });
export const schema = (type: string) => answer<{ text: string; path: string | null }>(`/schema?type=${encodeURIComponent(type)}`);

/** The palette; null while it is still the one of that mark. */
export async function palette(mark: string): Promise<Omit<Palette, "datatypes"> | null> {
  const found = await answer<Omit<Palette, "datatypes"> | { mark: string }>(`/palette?mark=${mark}`);
  return "behaviors" in found ? found : null;
}
