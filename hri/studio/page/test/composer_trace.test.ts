import assert from "node:assert/strict";
import test from "node:test";
import { readNetwork } from "../src/composer/network";
import { why } from "../src/composer/trace";
import { PALETTE } from "./sample_palette";

const NETWORK = readNetwork(`<BehaviorNetwork>
  <Behavior id="range" type="Hri.RangeSensor"/><Behavior id="other" type="Hri.RangeSensor"/>
  <Behavior id="half" type="Hri.Constant"><Parameter name="parsed_value" value="0.5"/></Behavior>
  <Behavior id="least" type="Evolution.Minimum"/><Behavior id="scale" type="Hri.Scale"/>
  <Behavior id="near" type="Hri.Greater"/><Behavior id="lone" type="Hri.Scale"/>
  <Behavior id="all" type="Hri.And"/><Behavior id="first" type="Hri.PriorityArbiter"/>
  <Behavior id="hold" type="Hri.Inhibit"/><Behavior id="pick" type="Hri.Select"/><Behavior id="share" type="Hri.Division"/>
  <Link from="range.distance" to="least.input"/><Link from="other.distance" to="least.input"/><Link from="half.value" to="least.input"/>
  <Link from="least.minimum" to="scale.input"/><Link from="scale.output" to="board.speed"/><Link from="board.wish" to="first.input"/>
  <Link from="range.distance" to="near.first"/><Link from="half.value" to="near.second"/>
  <Link from="near.is_greater" to="all.input"/><Link from="board.ready" to="all.input"/>
  <Link from="scale.output" to="first.input"/><Link from="lone.output" to="share.dividend"/><Link from="half.value" to="share.divisor"/>
  <Link from="scale.output" to="hold.input"/><Link from="all.result" to="hold.inhibitor"/>
  <Link from="all.result" to="pick.choice"/><Link from="range.distance" to="pick.when_true"/><Link from="other.distance" to="pick.when_false"/>
</BehaviorNetwork>`);

const VALUES = { "range.distance": 0, "other.distance": 2, "half.value": 0.5, "least.minimum": 0, "scale.output": 0, "near.is_greater": false, "board.ready": true, "all.result": false, "hold.output": 0 };

const ports = (port: string, values: Record<string, unknown> = VALUES, resting: string[] = []) => why(NETWORK, PALETTE, values, port, resting).map((one) => one.port);
const text = (port: string, values: Record<string, unknown> = VALUES, resting: string[] = []) => why(NETWORK, PALETTE, values, port, resting)[0]!.text;

test("the way back goes through what decided to the sensor", () => {
  assert.deepEqual(why(NETWORK, PALETTE, VALUES, "scale.output"), [
    { port: "scale.output", value: 0, text: "Hri.Scale makes it of its inputs" },
    { port: "least.minimum", value: 0, text: "the least of its inputs" },
    { port: "range.distance", value: 0, text: "Hri.RangeSensor senses it" },
  ]);
  assert.deepEqual(ports("scale.input"), ["least.minimum", "range.distance"], "an input begins with what reaches it");
  assert.deepEqual(ports("board.speed"), ["board.speed", "scale.output", "least.minimum", "range.distance"]);
});

test("a constant and a slot that others write are ends", () => {
  assert.equal(text("half.value"), "Hri.Constant makes it: parsed_value = 0.5");
  assert.equal(text("board.wish"), "read from the board: another network or a task writes it");
});

test("who decides depends on the type", () => {
  assert.deepEqual(ports("all.result").slice(0, 2), ["all.result", "near.is_greater"]);
  assert.deepEqual(ports("first.winner").slice(0, 2), ["first.winner", "scale.output"]);
  assert.deepEqual(ports("first.winner", { ...VALUES, "board.wish": 3 }), ["first.winner", "board.wish"]);
  assert.deepEqual([text("pick.selected"), ports("pick.selected").slice(1, 3)], ["the choice is false", ["all.result", "other.distance"]]);
  assert.equal(text("hold.output"), "nothing holds it back");
  const held = { ...VALUES, "all.result": true };
  assert.deepEqual([text("hold.output", held), ports("hold.output", held)[1]], ["it is held back by its inhibitor", "all.result"]);
  assert.equal(text("share.quotient", { ...VALUES, "lone.output": 1, "half.value": 0 }), "nothing can be divided by 0");
});

test("what is empty is explained", () => {
  assert.deepEqual(why(NETWORK, PALETTE, VALUES, "lone.input"), [{ port: "lone.input", value: null, text: "nothing was sent: nothing reaches lone.input" }]);
  assert.equal(text("lone.output"), "nothing was sent: nothing reaches lone.input");
  assert.deepEqual([text("share.quotient"), ports("share.quotient")], ["nothing was sent: nothing came to share.dividend", ["share.quotient", "lone.output"]]);
  assert.equal(text("scale.output", {}), "nothing was sent: nothing came to scale in this tick");
  assert.equal(text("range.distance", {}), "Hri.RangeSensor senses it: its device sends nothing now");
  assert.equal(text("scale.output", VALUES, ["scale"]), "scale rests after an error - the log says which");
  assert.equal(text("gone.output"), 'there is no behavior "gone"');
});

test("a circle, which a network on its way may have, ends", () => {
  const network = readNetwork('<N><Behavior id="a" type="T"/><Behavior id="b" type="T"/><Link from="a.o" to="b.i"/><Link from="b.o" to="a.i"/></N>');
  assert.deepEqual(why(network, PALETTE, { "a.o": 1, "b.o": 1 }, "a.o").map((one) => one.port), ["a.o", "b.o"]);
});
