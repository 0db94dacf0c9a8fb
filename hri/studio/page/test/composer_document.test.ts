import assert from "node:assert/strict";
import test, { mock } from "node:test";
import { fragmentOf } from "../src/composer/clipboard";
import { ComposerDocument } from "../src/composer/document";
import { addBehavior } from "../src/composer/edits";

const PALETTE = { mark: "known", behaviors: [], aliases: {}, datatypes: {}, slots: [], devices: [], broken: [] };

type Answer = { status: number; body: object };
interface Asked {
  what: string;
  answer(body: object, status?: number): Promise<void>;
}

/** A document whose questions to the server wait for an answer. */
function stage() {
  const asked: Asked[] = [];
  globalThis.localStorage = { length: 0, key: () => null, getItem: () => null, setItem: () => {}, removeItem: () => {} } as unknown as Storage;
  globalThis.document = { hidden: false } as unknown as Document;
  globalThis.fetch = ((url: string, { method = "GET" }: RequestInit = {}) =>
    new Promise((done) => {
      asked.push({
        what: `${method} ${decodeURIComponent(url).replace("/api/v1/networks", "")}`,
        answer: async (body, status = 200) => {
          done({ ok: status < 400, status, statusText: "", json: async () => body } satisfies Partial<Response> & { status: Answer["status"] } as unknown as Response);
          await settled();
        },
      });
    })) as unknown as typeof fetch;
  const one = (start: string) => asked.findLast(({ what }) => what.startsWith(start))!;
  return { doc: new ComposerDocument(), asked, one };
}

async function settled(): Promise<void> {
  for (let turn = 0; turn < 60; turn++) await Promise.resolve();
}

const file = (text: string, mark = "m") => ({ text, mark, is_writable: true, why: "", drafts: [], damaged: [] });
const text = (id: string) => `<BehaviorNetwork>\n  <Behavior id="${id}" type="Hri.Scale"/>\n</BehaviorNetwork>\n`;

async function opened(made: ReturnType<typeof stage>, path: string): Promise<void> {
  void made.doc.open(path);
  await settled();
  await made.one(`GET /file?path=${path}`).answer(file(text(path.slice(1))));
}

function edit(doc: ComposerDocument, id: string): void {
  doc.apply(addBehavior(doc.network, { id, type: "Hri.Scale" }, { x: 0, y: 0 }), `add ${id}`);
}

test.beforeEach(() => mock.timers.enable({ apis: ["setTimeout", "setInterval"] }));
test.afterEach(() => mock.timers.reset());

test("the last network that was asked for is shown, in whatever order answers and refusals come", async () => {
  const made = stage();
  await opened(made, "/first");
  const open = (path: string) => made.doc.open(path);
  const slow = [open("/slow"), open("/gone"), open("/last")];
  await settled();
  await made.one("GET /file?path=/last").answer(file(text("last")));
  await made.one("GET /file?path=/slow").answer(file(text("slow")));
  await made.one("GET /file?path=/gone").answer({ error: "there is none" }, 404);
  assert.deepEqual(await Promise.all(slow), [true, true, true]);
  assert.deepEqual([made.doc.path.value, made.doc.network.behaviors[0]!.id, made.doc.notice.value], ["/last", "last", ""]);
});

test("going back to what is shown calls off what was asked for", async () => {
  const made = stage();
  await opened(made, "/first");
  const other = made.doc.open("/other");
  await settled();
  await made.doc.open("/first");
  await made.one("GET /file?path=/other").answer(file(text("other")));
  await other;
  assert.equal(made.doc.path.value, "/first");
});

test("a save that is answered after another network was opened changes nothing of that", async () => {
  const made = stage();
  await opened(made, "/first");
  edit(made.doc, "more");
  const saved = made.doc.save();
  await settled();
  await opened(made, "/second");
  edit(made.doc, "mine");
  await made.one("PUT /file").answer({ mark: "of the first" });
  await saved;
  assert.equal(made.doc.history.isDirty, true);
  void made.doc.save();
  await settled();
  await made.one("PUT /file").answer({ error: "changed", text: text("second"), mark: "m" }, 409);
  assert.equal(made.doc.question.value?.kind, "changed");
});

test("what is typed while it is saved as another file stays", async () => {
  const made = stage();
  await opened(made, "/first");
  edit(made.doc, "more");
  const saved = made.doc.saveAs("/copy");
  await settled();
  await made.one("GET /new").answer({ path: "/copy" });
  edit(made.doc, "typed");
  await made.one("PUT /file").answer({ mark: "copied" });
  await made.one("DELETE /draft").answer({});
  assert.equal(await saved, "/copy");
  assert.deepEqual([made.doc.path.value, made.doc.history.isDirty], ["/copy", true]);
  assert.deepEqual(made.doc.network.behaviors.map(({ id }) => id), ["first", "more", "typed"]);
});

test("a file that has what is here is no question", async () => {
  const made = stage();
  await opened(made, "/first");
  edit(made.doc, "more");
  void made.doc.save();
  await settled();
  await made.one("PUT /file").answer({ error: "changed", text: made.doc.history.text, mark: "theirs" }, 409);
  assert.deepEqual([made.doc.question.value, made.doc.history.isDirty], [null, false]);
});

test("a network whose file was removed is unsaved again when it is kept", async () => {
  const made = stage();
  await opened(made, "/first");
  edit(made.doc, "more");
  void made.doc.save();
  await settled();
  await made.one("PUT /file").answer({ error: "was removed", text: "", mark: null }, 409);
  made.doc.chooseText(false);
  made.doc.undo();
  assert.equal(made.doc.history.isDirty, true);
});

test("a palette that comes slowly at first has not changed", async () => {
  const made = stage();
  made.doc.begin();
  mock.timers.tick(7000);
  const palettes = made.asked.filter(({ what }) => what.startsWith("GET /palette"));
  assert.equal(palettes.length, 1);
  await palettes[0]!.answer(PALETTE);
  assert.equal(made.doc.notice.value, "");
  mock.timers.tick(2000);
  await made.one("GET /palette?mark=known").answer({ ...PALETTE, mark: "another" });
  assert.match(made.doc.notice.value, /changed/);
  made.doc.end();
});

test("behaviors are found in the text of a mail, and nothing in what has none", () => {
  const plain = '<Behavior id="a" type="T"/>\n<Link from="a.o" to="b.i"/>';
  const found = [
    text("a"),
    `Try this:\n\n${plain}\n\nYours`,
    `> On Monday you wrote:\n> > <Behavior id="a" type="T">\n> >   <Parameter name="p" value="a > b"/>\n> > </Behavior>`,
    `\ufeff<?xml version="1.0"?>\r\n<BehaviorNetwork>\r\n\u00a0 <Behavior id="a" type="T"/>\r\n</BehaviorNetwork>`,
  ];
  for (const one of found) assert.ok(fragmentOf(one), one);
  const none = ["", "hello", "<html/>", "<BehaviorNetwork/>", '<BehaviorSchema type="T"/>', "<Behavior id='a'", '<Behavior id="a"/>', '<Link from="a.o" to="b.i"/>', "<BehaviorNetwork ".repeat(50_000), "<Link ".repeat(150_000), `${plain}${" ".repeat(1_000_000)}`];
  for (const one of none) assert.equal(fragmentOf(one), null, one.slice(0, 50));
});
