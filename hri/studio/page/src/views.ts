// Which view the address shows: `#recordings/FOLDER`, `#networks/FILE`, else what happens live.

export const VIEWS = ["live", "networks", "recordings"] as const;

export interface View {
  name: (typeof VIEWS)[number];
  /** The folder of a recording, or the file of a network; empty for none. */
  path: string;
}

export function viewOf(hash: string): View {
  const found = /^#(recordings|networks)(?:\/(.*))?$/s.exec(hash);
  if (found === null) return { name: "live", path: "" };
  const name = found[1] as View["name"];
  try {
    return { name, path: decodeURIComponent(found[2] ?? "") };
  } catch {
    return { name, path: "" };
  }
}

export function hashOf(name: View["name"], path: string): string {
  return `#${name}/${encodeURIComponent(path).replaceAll("%2F", "/")}`;
}
