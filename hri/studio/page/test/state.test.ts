import assert from "node:assert/strict";
import test from "node:test";
import { MOST_EVENTS, ago, bounds, empty, forgetEvents, freeName, lineOf, movables, putCommand, summary, take, matching } from "../src/state";

const feeling = { label: "joy", words: "happy", why: "", pleasure: 0.5, arousal: 0, dominance: 0, emotions: {}, drives: {}, causes: [] };

test("the newest value of a topic counts", () => {
  const state = empty();
  take(state, { topic: "feeling", value: feeling });
  take(state, { topic: "feeling", value: { ...feeling, label: "fear" } });
  assert.equal(state.values.feeling?.label, "fear");
});

test("whatever is in the room can be put elsewhere", () => {
  const world = { walls: [], circles: [], people: [{ name: "", at: [1, 2], is_present: true }, { name: "Ann", at: [2, 2], is_present: true }], things: [{ name: "cup", at: [0, 1] }], obstacles: [{ name: "obstacle 1", at: [3, 0], radius: 0.15 }] };
  const commands = movables(world).map((one) => putCommand(one, 1, 2));
  assert.deepEqual(commands, [
    ["visitor_go", { x: 1, y: 2 }],
    ["visitor_go", { x: 1, y: 2, who: "Ann" }],
    ["place", { name: "cup", x: 1, y: 2 }],
    ["obstacle", { name: "obstacle 1", x: 1, y: 2 }],
  ]);
  assert.equal(freeName("obstacle", movables(world)), "obstacle 2");
  assert.equal(freeName("thing", movables(world)), "thing 1");
});

test("an age is told in seconds or minutes", () => {
  assert.deepEqual([ago(0.2), ago(59), ago(90)], ["0 s ago", "59 s ago", "2 min ago"]);
});

test("what was heard, ignored and said are lines", () => {
  const state = empty();
  for (const event of ["speech.heard", "speech.rejected", "speech.said", "person.seen"])
    take(state, { event: { t: 1, event, text: "hello", reason: "low confidence", confidence: 0.82 } });
  assert.deepEqual(state.lines.map((one) => one.who), ["person", "ignored", "robot"]);
  assert.equal(state.lines[0]!.detail, "82 % sure");
  assert.equal(state.lines[1]!.detail, "low confidence");
});

test("rejected words are not shown", () => {
  assert.equal(lineOf({ t: 0, event: "speech.rejected", text: "a secret", reason: "not now" })!.text, "ignored");
});

test("a typed sentence that is ignored is shown with the nearest one, what was said never", () => {
  const event = { t: 0, event: "speech.rejected", text: "turn arround", reason: "not in grammar", detail: "", nearest: "turn around" };
  assert.equal(lineOf({ ...event, typed: true })!.detail, 'not in grammar. Nearest: "turn around"');
  assert.equal(lineOf(event)!.detail, "not in grammar");
});

test("what can be said is found by its words, its rule, and what it is about", () => {
  const turn = { rule: "turn", about: "On the spot.", examples: ["turn left"] };
  const time = { rule: "time", about: "", examples: ["what time is it"] };
  assert.deepEqual(matching([turn, time], ""), [turn, time]);
  assert.deepEqual(matching([turn, time], " SPOT"), [turn]);
  assert.deepEqual(matching([turn, time], "what"), [time]);
});

test("a typed sentence that is ignored is shown with the reason", () => {
  const event = { t: 0, event: "speech.rejected", text: "turn arround", typed: true, reason: "not in grammar", detail: 'did you mean "around"?' };
  assert.deepEqual(lineOf(event), { time: 0, who: "ignored", text: "turn arround", detail: 'not in grammar: did you mean "around"?' });
});

test("a page that comes back begins its lines anew", () => {
  const state = empty();
  take(state, { topic: "feeling", value: feeling });
  take(state, { event: { t: 1, event: "speech.said", text: "hello" } });
  forgetEvents(state);
  take(state, { event: { t: 1, event: "speech.said", text: "hello" } });
  assert.deepEqual([state.lines.length, state.events.length, state.values.feeling], [1, 1, feeling]);
});

test("a robot that talks for days does not fill the page", () => {
  const state = empty();
  for (let step = 0; step < 2 * MOST_EVENTS; step++) take(state, { event: { t: step, event: "person.seen" } });
  assert.equal(state.events.length, MOST_EVENTS);
  assert.equal(state.events.at(-1)!.t, 2 * MOST_EVENTS - 1);
});

test("an event is summed up without its name and time", () => {
  assert.equal(summary({ t: 1, event: "drive.stopped", reason: "e-stop", words: "x" }), "reason e-stop, words x");
});

test("the room's bounds hold the walls, the robot and the people", () => {
  const world = { walls: [[0, 0, 4, 0]], circles: [], things: [], obstacles: [], people: [{ name: "", at: [5, 3], is_present: true }] };
  const [left, low, width, height] = bounds(world, undefined);
  assert.ok(left < -1 && low < -1 && left + width > 6 && low + height > 4);
  const far = { ...world, obstacles: [{ name: "rock", at: [100, 100], radius: 0.15 }] };
  assert.deepEqual(bounds(far, undefined), [left, low, width, height]);
});
