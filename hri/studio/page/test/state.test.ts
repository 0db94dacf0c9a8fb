import assert from "node:assert/strict";
import test from "node:test";
import { MOST_EVENTS, MOST_MOODS, bounds, empty, lineOf, note, summary, take } from "../src/state";

const feeling = { label: "joy", words: "happy", why: "", pleasure: 0.5, arousal: 0, dominance: 0, emotions: {}, drives: {}, causes: [] };

test("the newest value of a topic counts", () => {
  const state = empty();
  take(state, { topic: "feeling", value: feeling }, 1);
  take(state, { topic: "feeling", value: { ...feeling, label: "fear" } }, 2);
  assert.equal(state.values.feeling?.label, "fear");
  assert.deepEqual(state.moods.map((one) => one.time), [1, 2]);
});

test("moods come twice a second at most, and five minutes of them are kept", () => {
  const state = empty();
  state.values.feeling = feeling;
  for (let step = 0; step < 10 * MOST_MOODS; step++) note(state, step * 0.1);
  assert.equal(state.moods.length, MOST_MOODS);
  assert.ok(state.moods.at(-1)!.time > 10 * MOST_MOODS * 0.1 - 1);
});

test("what was heard, ignored and said are lines", () => {
  const state = empty();
  for (const event of ["speech.heard", "speech.rejected", "speech.said", "person.seen"])
    take(state, { event: { t: 1, event, text: "hello", reason: "low confidence", confidence: 0.82 } }, 1);
  assert.deepEqual(state.lines.map((one) => one.who), ["person", "ignored", "robot"]);
  assert.equal(state.lines[0]!.detail, "82 % sure");
  assert.equal(state.lines[1]!.detail, "low confidence");
});

test("rejected words are not shown", () => {
  assert.equal(lineOf({ t: 0, event: "speech.rejected", text: "a secret", reason: "not now" })!.text, "ignored");
});

test("a robot that talks for days does not fill the page", () => {
  const state = empty();
  for (let step = 0; step < 2 * MOST_EVENTS; step++) take(state, { event: { t: step, event: "person.seen" } }, step);
  assert.equal(state.events.length, MOST_EVENTS);
  assert.equal(state.events.at(-1)!.t, 2 * MOST_EVENTS - 1);
});

test("an event is summed up without its name and time", () => {
  assert.equal(summary({ t: 1, event: "drive.stopped", reason: "e-stop", words: "x" }), "reason e-stop, words x");
});

test("the room's bounds hold the walls, the robot and the people", () => {
  const world = { walls: [[0, 0, 4, 0]] as [number, number, number, number][], circles: [], things: [], people: [{ name: "", at: [5, 3] as [number, number], is_present: true }] };
  const [left, low, width, height] = bounds(world, undefined);
  assert.ok(left < -1 && low < -1 && left + width > 6 && low + height > 4);
});
