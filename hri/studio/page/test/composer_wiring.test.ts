import assert from "node:assert/strict";
import test from "node:test";
import { addLink, applySplices } from "../src/composer/edits";
import { readNetwork } from "../src/composer/network";
import { behaviorKind, canLink, portsOf } from "../src/composer/wiring";
import { large, milliseconds } from "./plain_network";
import { PALETTE } from "./sample_palette";

const NETWORK = readNetwork(`<BehaviorNetwork>
  <Behavior id="range" type="Hri.RangeSensor"/><Behavior id="sum" type="Evolution.Addition"/><Behavior id="scale" type="Hri.Scale"/>
  <Behavior id="wheel" type="Hri.Wheel"/><Behavior id="not" type="Hri.Not"/><Behavior id="pick" type="Hri.Select"/>
  <Behavior id="mine" type="My.Own"/><Behavior id="voice" type="Hri.Voice"/>
  <Link from="range.distance" to="sum.input"/><Link from="sum.sum" to="scale.input"/>
  <Link from="mine.out" to="board.level"/><Link from="board.level" to="not.input"/><Link from="mine.out" to="mine2.in"/>
  <Link from="range.distance" to="board.near"/>
</BehaviorNetwork>`);

const reason = (from: string, to: string) => {
  const found = canLink(NETWORK, PALETTE, from, to);
  return found.ok ? found.warning : found.reason;
};

test("a type is known by its names of today and of 2003", () => {
  for (const name of ["Hri.Addition", "Evolution.Addition", "Examples.Adder"]) assert.equal(behaviorKind(PALETTE, name)?.type, "Hri.Addition");
  assert.equal(behaviorKind(PALETTE, "My.Own"), undefined);
});

test("a behavior of an unknown type has the ports that links name; a slot has the type of what uses it", () => {
  const named = (id: string) => {
    const { inputs, outputs } = portsOf(NETWORK, PALETTE, id);
    return [inputs, outputs].map((all) => all.map((one) => `${one.name}:${one.datatype}`));
  };
  assert.deepEqual(named("mine"), [[], ["out:any"]]);
  assert.deepEqual(named("gone"), [[], []]);
  assert.deepEqual(named("sum"), [["input:double"], ["sum:double"]]);
  assert.deepEqual(named("board.level"), [["level:boolean"], ["level:boolean"]]);
  assert.deepEqual(named("board.drive.command"), [["drive.command:twist"], ["drive.command:twist"]]);
  assert.deepEqual(named("board.other"), [["other:any"], ["other:any"]]);
});

test("an output has the datatype that its parameters decide, as the robot reads them", () => {
  const network = readNetwork('<N><Behavior id="a" type="Hri.Constant"/><Behavior id="b" type="Hri.Constant"/></N>');
  const palette = { ...PALETTE, datatypes: { "a.value": "string" } };
  assert.deepEqual(["a", "b"].map((id) => portsOf(network, palette, id).outputs[0]!.datatype), ["string", "any"]);
});

test("what fits may be linked", () => {
  for (const [from, to] of [["scale.output", "wheel.speed"], ["not.result", "pick.choice"], ["range.distance", "pick.when_true"], ["mine.new", "sum.input"], ["sum.sum", "board.near"], ["pick.selected", "not.input"], ["scale.output", "board.my-slot.2"]])
    assert.equal(reason(from!, to!), "", `${from} -> ${to}`);
});

test("two meanings of a port, or of a slot, are warned of", () => {
  assert.deepEqual(canLink(NETWORK, PALETTE, "range.distance", "wheel.speed"), { ok: true, warning: "range.distance means Hri.Distance, wheel.speed wants Hri.Speed" });
  assert.deepEqual(canLink(NETWORK, PALETTE, "board.near", "wheel.speed"), { ok: true, warning: "board.near: wheel.speed means Hri.Speed, range.distance means Hri.Distance" });
});

test("what is forbidden is refused with the reason", () => {
  for (const [from, to, words] of [
    ["gone.out", "sum.input", 'no behavior "gone" for the link "gone.out"'],
    ["sum.out", "scale.input", 'Evolution.Addition "sum" has no output "out"'],
    ["sum.sum", "scale.sum", 'Hri.Scale "scale" has no input "sum"'],
    ["not.result", "sum.input", "not.result is boolean, but sum.input takes double - link ports of the same datatype"],
    ["sum.sum", "scale.input", "the link sum.sum -> scale.input is there already"],
    ["scale.output", "sum.input", "these links would run in a circle: scale.output -> sum.input, sum.sum -> scale.input"],
    ["not.result", "not.input", "these links would run in a circle: not.result -> not.input"],
    ["board.drive.command", "sum.input", "board.drive.command is twist (here it is what tasks ask the base for), but sum.input is double - link ports of the same datatype"],
    ["sum.sum", "board.level", "board.level is boolean (not.input), but sum.sum is double - link ports of the same datatype"],
    ["board.level", "sum.input", "board.level is boolean, but sum.input takes double - link ports of the same datatype"],
    ["sum.sum", "board.a b", '"board.a b" is not a slot of the board - write board.name, such as board.speech'],
    ["board.a", "board.b", "both are slots of the board - link a behavior to one"],
  ] as const)
    assert.equal(reason(from, to), words);
});

test("a slot closes no circle", () => {
  assert.equal(reason("not.result", "board.level"), "");
});

test("a circle is found however long it is, and in any network a link is judged at once", () => {
  const network = readNetwork(large(300));
  const found = canLink(network, PALETTE, "part299.output", "part0.input");
  assert.ok(!found.ok && found.reason.startsWith("these links would run in a circle: part299.output -> part0.input, part0.output -> "));
  const took = milliseconds(() => {
    const fresh = readNetwork(applySplices(network.text, addLink(network, "part0.output", "board.x")));
    return fresh.behaviors.map(({ id }) => canLink(fresh, PALETTE, "part150.output", `${id}.input`));
  });
  console.log(`judging a link to each of 300 behaviors: ${took.toFixed(1)} ms`);
  assert.ok(took < 50, `${took} ms`);
});
