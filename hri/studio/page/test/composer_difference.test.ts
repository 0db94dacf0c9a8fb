import assert from "node:assert/strict";
import test from "node:test";
import { arrange } from "../src/composer/arrange";
import { compare } from "../src/composer/difference";
import { applySplices } from "../src/composer/edits";
import { readNetwork, type Network } from "../src/composer/network";
import { command, large, milliseconds, plain, random } from "./plain_network";
import { PALETTE } from "./sample_palette";

const OLD = readNetwork(`<BehaviorNetwork name="n">
  <Behavior id="a" type="Hri.Scale"><Parameter name="factor" value="2"/></Behavior><Behavior id="b" type="Hri.Not"/>
  <Link from="a.output" to="board.x"/>
</BehaviorNetwork>`);

test("a difference names what is added, removed and changed, with both values", () => {
  const next = readNetwork(`<BehaviorNetwork name="m" invocation_interval="0.1">
    <Behavior id="a" type="Hri.Clamp"><Parameter name="low" value="1"/></Behavior><Behavior id="c" type="Hri.Not"/>
    <Link from="a.output" to="board.y"/>
  </BehaviorNetwork>`);
  assert.deepEqual(compare(OLD, next), {
    added: ["c"],
    removed: ["b"],
    changed: [{ id: "a", what: ["type Hri.Scale → Hri.Clamp", "factor 2 → (default)", "low (default) → 1"] }],
    links: { added: ["a.output -> board.y"], removed: ["a.output -> board.x"] },
    attributes: ["name n → m", "interval (default) → 0.1"],
    isSame: false,
  });
});

test("places, order and comments are a difference of the text alone", () => {
  const moved = readNetwork(OLD.text.replace("</Beh", "<!-- c --></Beh"));
  assert.deepEqual(compare(OLD, moved), { added: [], removed: [], changed: [], links: { added: [], removed: [] }, attributes: [], isSame: false });
  assert.equal(compare(OLD, readNetwork(OLD.text)).isSame, true);
});

test("of random networks, what one way adds the other removes, and nothing is left out", () => {
  const chance = random(3);
  const types = PALETTE.behaviors.map((one) => one.type);
  let before: Network = OLD;
  for (let number = 0; number < 300; number++) {
    const next = readNetwork(applySplices(before.text, command(before, PALETTE, types, chance).splices));
    const [there, back] = [compare(before, next), compare(next, before)];
    assert.deepEqual([there.added, there.removed, there.links.added], [back.removed, back.added, back.links.removed]);
    assert.deepEqual(there.changed.map((one) => one.id).sort(), back.changed.map((one) => one.id).sort());
    const { boxes: _, ...meant } = plain(before);
    const { boxes: __, ...then } = plain(next);
    const isEmpty = [there.added, there.removed, there.changed, there.links.added, there.links.removed, there.attributes].every((one) => one.length === 0);
    assert.equal(isEmpty, JSON.stringify(meant) === JSON.stringify(then));
    before = next;
  }
});

const size = () => ({ width: 160, height: 90 });

test("an arrangement goes from left to right, and no part covers another", () => {
  const network = readNetwork(large(60));
  const boxes = arrange(network, size);
  assert.equal(boxes.size, 60);
  for (const { from, to } of network.links) assert.ok(boxes.get(from.split(".")[0]!)!.x + 160 < boxes.get(to.split(".")[0]!)!.x, `${from} -> ${to}`);
  const all = [...boxes.values()];
  assert.ok(all.every((a, at) => all.slice(at + 1).every((b) => Math.abs(a.x - b.x) >= 160 || Math.abs(a.y - b.y) >= 90)));
  assert.ok(all.every(({ x, y }) => Number.isInteger(x) && Number.isInteger(y) && x >= 0 && y >= 0));
  assert.deepEqual(arrange(network, size), boxes, "the same again");
});

test("slots are parts of an arrangement; circles and lost ends do not stop it", () => {
  const network = readNetwork('<N><Behavior id="a" type="T"/><Behavior id="b" type="T"/><Link from="a.o" to="b.i"/><Link from="b.o" to="a.i"/><Link from="gone.o" to="a.i"/><Link from="board.x.y" to="a.i"/><Link from="b.o" to="board.x.y"/><Link from="a.o" to="a.i"/></N>');
  assert.deepEqual([...arrange(network, size).keys()].sort(), ["a", "b", "board.x.y"]);
  assert.equal(arrange(readNetwork("<N/>"), size).size, 0);
});

test("a network of 300 behaviors is arranged in time", () => {
  const network = readNetwork(large(300));
  const took = milliseconds(() => arrange(network, size), 3);
  console.log(`arranging 300 behaviors: ${took.toFixed(0)} ms`);
  assert.ok(took < 3000, `${took} ms`);
});
