// What the page asks of the server about networks: files, drafts, what is wrong, what there is.

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
  text: string;
  /** Of the file that the draft began from; null where there was none. */
  mark: string | null;
  /** Seconds since 1970. */
  time: number;
}

export interface OpenedFile {
  path: string;
  text: string;
  mark: string | null;
  is_writable: boolean;
  why: string;
  draft: Draft | null;
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

async function answer<T>(path: string, method = "GET", body?: unknown, keepalive = false): Promise<T> {
  const response = await fetch(ROOT + path, {
    method,
    keepalive,
    ...(body === undefined ? {} : { body: JSON.stringify(body), headers: { "content-type": "application/json" } }),
  });
  const told = (await response.json()) as Record<string, unknown>;
  if (!response.ok) throw new Refusal(String(told.error ?? response.statusText), response.status, told);
  return told as T;
}

const at = (path: string) => `path=${encodeURIComponent(path)}`;

export const networks = () => answer<{ networks: NetworkFile[]; home: string }>("");
export const open = (path: string) => answer<OpenedFile>(`/file?${at(path)}`);
export const save = (path: string, text: string, mark: string | null) => answer<{ mark: string }>("/file", "PUT", { path, text, mark });
export const keepDraft = (path: string, text: string, mark: string | null, isLast: boolean) =>
  answer<object>("/draft", "PUT", { path, text, mark }, isLast);
export const dropDraft = (path: string) => answer<object>(`/draft?${at(path)}`, "DELETE");
export const watch = (path: string, mark: string | null) =>
  answer<{ mark: string | null; text?: string }>(`/watch?${at(path)}&mark=${mark ?? ""}`);
export const check = (path: string, text: string) => answer<Checked>("/check", "POST", { path, text });
export const schema = (type: string) => answer<{ text: string; path: string | null }>(`/schema?type=${encodeURIComponent(type)}`);

/** The palette; null while it is still the one of that mark. */
export async function palette(mark: string): Promise<Palette | null> {
  const found = await answer<Palette | { mark: string }>(`/palette?mark=${mark}`);
  return "behaviors" in found ? found : null;
}
