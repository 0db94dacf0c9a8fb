import assert from "node:assert/strict";
import test, { mock } from "node:test";
import { Autosave, DRAFT_AFTER_MS, type Open } from "../src/composer/autosave";
import { Refusal } from "../src/composer/server";
import { Unkept, type Unsaved } from "../src/composer/unkept";

/** The storage of a browser, with room for this many texts. */
function storage(room = 100): Storage {
  const texts = new Map<string, string>();
  return {
    get length() {
      return texts.size;
    },
    key: (number: number) => [...texts.keys()][number] ?? null,
    getItem: (name: string) => texts.get(name) ?? null,
    setItem: (name: string, text: string) => {
      if (!texts.has(name) && texts.size >= room) throw new Error("QuotaExceededError");
      texts.set(name, text);
    },
    removeItem: (name: string) => void texts.delete(name),
  } as unknown as Storage;
}

/** A page with its server: what is open, what the disk has, and why it takes nothing. */
function stage(browser = storage()) {
  const disk = new Map<string, string>();
  const made = {
    open: { page: "p", path: "/one.xml", text: null, mark: "m", count: 1 } as Open,
    why: null as Error | null,
    disk,
    autosave: null as unknown as Autosave,
    unkept: new Unkept(() => browser),
    edit(text: string | null): void {
      made.open = { ...made.open, text, count: made.open.count + 1 };
      made.autosave.changed();
    },
    leave(page: string): void {
      made.autosave.keep();
      made.open = { page, path: `/${page}.xml`, text: null, mark: "m", count: made.open.count + 1 };
    },
  };
  const drafts = {
    keep: async (one: Unsaved) => {
      if (made.why) throw made.why;
      disk.set(one.page, one.text);
    },
    drop: async (_: string, page: string) => {
      if (made.why) throw made.why;
      disk.delete(page);
    },
  };
  made.autosave = new Autosave(() => made.open, made.unkept, drafts);
  return made;
}

async function pass(milliseconds = DRAFT_AFTER_MS): Promise<void> {
  mock.timers.tick(milliseconds);
  for (let turn = 0; turn < 50; turn++) await Promise.resolve();
}

test.beforeEach(() => mock.timers.enable({ apis: ["setTimeout"] }));
test.afterEach(() => mock.timers.reset());

test("an edit has a draft soon, and none when it is as it was", async () => {
  const { autosave, disk, edit } = stage();
  edit("<a/>");
  await pass();
  assert.deepEqual([...disk], [["p", "<a/>"]]);
  assert.match(autosave.state.value, /^draft kept at/);
  edit(null);
  await pass();
  assert.deepEqual([...disk], []);
});

test("what is left at once has its draft, whatever is open then", async () => {
  const { disk, edit, leave } = stage();
  edit("<a/>");
  leave("two");
  edit("<b/>");
  leave("three");
  await pass();
  assert.deepEqual([...disk], [["p", "<a/>"], ["two", "<b/>"]]);
});

test("what the server cannot take waits in the browser until it can", async () => {
  const made = stage();
  made.why = new TypeError("Failed to fetch");
  made.edit("<a/>");
  made.leave("two");
  await pass(0);
  assert.equal(made.autosave.left.value, "one.xml: no draft is kept - no link to the robot; this browser has it");
  assert.deepEqual(made.unkept.all().map(({ path, text }) => [path, text]), [["/one.xml", "<a/>"]]);
  assert.deepEqual(made.autosave.unkeptOf("/one.xml").map(({ text }) => text), ["<a/>"]);
  made.why = null;
  await pass(1000);
  assert.deepEqual([...made.disk], [["p", "<a/>"]]);
  assert.deepEqual([made.unkept.all(), made.autosave.left.value], [[], ""]);
});

test("what a page could not keep before it was closed is kept by the next, or offered", async () => {
  const browser = storage();
  const closed = stage(browser);
  closed.why = new TypeError("Failed to fetch");
  closed.edit("<a/>");
  await pass();
  mock.timers.reset();
  mock.timers.enable({ apis: ["setTimeout"] });
  const next = stage(browser);
  next.open = { ...next.open, page: "q" };
  next.why = new Refusal("the folder is write-protected", 409, {});
  await next.autosave.again();
  assert.deepEqual(next.autosave.unkeptOf("/one.xml").map(({ page, text }) => [page, text]), [["p", "<a/>"]]);
  next.why = null;
  await next.autosave.again();
  assert.deepEqual([...next.disk], [["p", "<a/>"]]);
  assert.deepEqual(next.autosave.unkeptOf("/one.xml"), []);
});

test("a browser without room says so, and goes on trying", async () => {
  const made = stage(storage(0));
  made.why = new Refusal("the disk is full", 409, {});
  made.edit("<a/>");
  await pass();
  assert.equal(made.autosave.state.value, "no draft is kept - the disk is full");
  made.why = null;
  await pass(1000);
  assert.deepEqual([...made.disk], [["p", "<a/>"]]);
});

test("a draft that someone discarded is kept again", async () => {
  const { autosave, disk, edit } = stage();
  edit("<a/>");
  await pass();
  disk.clear();
  autosave.isMissing("p");
  await pass();
  assert.deepEqual([...disk], [["p", "<a/>"]]);
});

test("a draft that is continued is dropped when there is another with its text, not before", async () => {
  const made = stage();
  made.disk.set("old", "<a/>");
  made.why = new TypeError("Failed to fetch");
  made.edit("<a/>");
  made.autosave.replaces("p", { path: "/one.xml", page: "old", seen: "" });
  await pass();
  assert.deepEqual([...made.disk.keys()], ["old"]);
  made.why = null;
  await pass(1000);
  assert.deepEqual([...made.disk.keys()], ["p"]);
});

test("a save forgets what it has, and nothing that was typed since", async () => {
  const made = stage();
  made.edit("<a/>");
  const { count } = made.open;
  made.edit("<b/>");
  made.autosave.saved("p", "<a/>", count);
  await pass();
  assert.deepEqual([...made.disk], [["p", "<b/>"]]);
});

test("what is damaged in the browser's storage is left alone", () => {
  const browser = storage();
  for (const [number, text] of ["", "{", "null", "[]", '{"page": 3}', '{"page":"a","path":"/x","text":"t","count":"1"}'].entries()) browser.setItem(`hri draft ${number}`, text);
  browser.setItem("another", "{}");
  const unkept = new Unkept(() => browser);
  assert.deepEqual(unkept.all(), []);
  assert.equal(browser.length, 7);
  assert.deepEqual(new Unkept(() => { throw new Error("SecurityError"); }).all(), []);
});
