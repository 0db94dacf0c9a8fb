// What is not saved and could not be kept as a draft on the robot: the browser has it meanwhile.

/** What a page has not saved of a network. */
export interface Unsaved {
  /** Names the opening of the network in a page; its draft is of that name. */
  page: string;
  path: string;
  text: string;
  /** Of the file that it began from; null where there was none. */
  mark: string | null;
  /** Rises with each change. */
  count: number;
  /** Seconds since 1970. */
  time: number;
}

const PREFIX = "hri draft ";

/** By page, in the storage of the browser, which its other pages and its next start see, too. */
export class Unkept {
  constructor(private readonly storage: () => Storage) {}

  /** Whether it is there now; a browser may have no room, or keep nothing. */
  put(one: Unsaved): boolean {
    try {
      this.storage().setItem(PREFIX + one.page, JSON.stringify(one));
      return true;
    } catch {
      return false;
    }
  }

  all(): Unsaved[] {
    try {
      const storage = this.storage();
      const names = Array.from({ length: storage.length }, (_, number) => storage.key(number) ?? "");
      return names.filter((name) => name.startsWith(PREFIX)).flatMap((name) => read(storage.getItem(name)));
    } catch {
      return [];
    }
  }

  /** Forget a text and those before it; what came later stays. */
  drop({ page, count }: Pick<Unsaved, "page" | "count">): void {
    try {
      const storage = this.storage();
      const [there] = read(storage.getItem(PREFIX + page));
      if (there === undefined || there.count <= count) storage.removeItem(PREFIX + page);
    } catch {
      // It keeps nothing.
    }
  }
}

function read(written: string | null): Unsaved[] {
  try {
    const found = JSON.parse(written ?? "") as Partial<Unsaved> | null;
    const isWhole = [found?.page, found?.path, found?.text].every((one) => typeof one === "string") && typeof found?.count === "number" && typeof found.time === "number";
    return isWhole ? [{ ...(found as Unsaved), mark: typeof found.mark === "string" ? found.mark : null }] : [];
  } catch {
    return [];
  }
}
