import assert from "node:assert/strict";
import test from "node:test";
import { addBehavior, addLink, move, remove, rename, stretch } from "../src/composer/edits";
import { History } from "../src/composer/history";
import { EMPTY } from "../src/composer/network";
import { large, milliseconds } from "./plain_network";

function begun(): History {
  const history = new History(EMPTY);
  history.apply(addBehavior(history.network!, { id: "a", type: "Hri.Minimum" }, { x: 0, y: 0 }), "add a");
  return history;
}

test("undo and redo name what they did, and there is an end of both", () => {
  const history = begun();
  const text = history.text;
  assert.deepEqual([history.undoLabel, history.redoLabel], ["add a", null]);
  assert.deepEqual([history.undo(), history.undo()], ["add a", null]);
  assert.deepEqual([history.text, history.undoLabel, history.redoLabel], [EMPTY, null, "add a"]);
  assert.deepEqual([history.redo(), history.redo()], ["add a", null]);
  assert.equal(history.text, text);
});

test("what changes nothing is no command", () => {
  const history = begun();
  const { revision } = history;
  assert.equal(history.apply(move(history.network!, new Map([["a", { x: 0, y: 0 }]])), "move"), false);
  history.reset(history.text, "the same");
  assert.deepEqual([history.revision, history.undoLabel], [revision, "add a"]);
});

test("a drag is one command, and two drags are two", () => {
  const history = begun();
  const drag = (key: string) => {
    for (let x = 1; x < 100; x++) history.apply(move(history.network!, new Map([["a", { x, y: x * 100 }]])), "move a", key);
  };
  const before = history.text;
  drag("drag 1");
  drag("drag 2");
  const text = history.text;
  assert.equal(history.undo(), "move a");
  assert.deepEqual(history.network!.boxes.get("a"), { x: 99, y: 9900 });
  assert.equal(history.undo(), "move a");
  assert.equal(history.text, before);
  history.redo();
  history.redo();
  assert.equal(history.text, text);
  history.undo();
  history.apply(move(history.network!, new Map([["a", { x: 5, y: 5 }]])), "move a", "drag 1");
  assert.deepEqual([history.undo(), history.undoLabel], ["move a", "move a"], "not joined with what was there before the undo");
});

test("a new command ends what could be done again", () => {
  const history = begun();
  history.undo();
  history.apply(addBehavior(history.network!, { id: "b", type: "Hri.Minimum" }), "add b");
  assert.deepEqual([history.redoLabel, history.redo()], [null, null]);
});

test("a text that is not XML can be written, mended, and undone", () => {
  const history = begun();
  const { text } = history;
  const type = (next: string) => history.apply([stretch(history.text, next)], "edit the XML", "xml");
  type(text.replace("<Layout>", "<Layout"));
  assert.deepEqual([history.network, history.error?.message], [null, "the tag <Layout> is not closed"]);
  type(text.replace("<Layout>", "<Layout >"));
  assert.deepEqual([history.network?.behaviors.length, history.error], [1, null]);
  history.reset("nothing", "take another text");
  assert.equal(history.error?.line, 1);
  assert.deepEqual([history.undo(), history.undo(), history.text], ["take another text", "edit the XML", text]);
});

test("it is changed as long as it is not what was saved", () => {
  const history = begun();
  assert.equal(history.isDirty, true);
  history.markSaved();
  assert.equal(history.isDirty, false);
  history.undo();
  assert.equal(history.isDirty, true);
  history.redo();
  assert.equal(history.isDirty, false);
  history.apply(addLink(history.network!, "a.minimum", "board.x"), "link", "k");
  history.markSaved();
  history.apply(rename(history.network!, "a", "b"), "rename", "k");
  history.undo();
  assert.equal(history.isDirty, false, "what comes after saving is not joined with what was saved");
});

test("followers hear of each change until they leave", () => {
  const history = begun();
  const heard: number[] = [];
  const leave = history.subscribe(() => heard.push(history.revision));
  history.undo();
  history.redo();
  leave();
  history.undo();
  assert.equal(heard.length, 2);
  assert.deepEqual(heard[1]! - heard[0]!, 1);
});

test("commands and undo in a network of 300 behaviors take less than 50 ms", () => {
  const history = new History(large(300));
  const ids = history.network!.behaviors.map((one) => one.id);
  const boxes = new Map(ids.map((id) => [id, { x: 7, y: 9 }]));
  const took = {
    "move all": milliseconds(() => move(history.network!, boxes)),
    "remove half": milliseconds(() => remove(history.network!, ids.filter((_, at) => at % 2), [])),
    "move all and undo": milliseconds(() => {
      history.apply(move(history.network!, boxes), "move");
      history.undo();
    }),
    "remove all and undo": milliseconds(() => {
      history.apply(remove(history.network!, ids, []), "remove");
      history.undo();
    }),
  };
  for (const [name, ms] of Object.entries(took)) {
    console.log(`${name} of 300: ${ms.toFixed(1)} ms`);
    assert.ok(ms < 50, `${name}: ${ms} ms`);
  }
});
