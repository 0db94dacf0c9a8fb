import assert from "node:assert/strict";
import test from "node:test";
import { Latest, MOST_EVENTS, Playhead, begun, clock, feelingAt, lastBy, moodAt, size, spoken, takePart, type About } from "../src/recording";
import type { RobotEvent } from "../src/state";

const about: About = {
  folder: "/a", name: "a", written: 0, bytes: 0, length: 10, is_growing: false, start: 0, end: 10,
  face: null, sound: null, wrong: [], words: { fear: "scared" },
};

function recorded(...events: RobotEvent[]) {
  const recording = begun(about);
  takePart(recording, { events, next: 0, is_all: true, skipped: 0 });
  return recording;
}

test("what was heard and said has marks as long as it took", () => {
  const recording = recorded(
    { t: 3, event: "speech.heard", text: "hello", start: 1, end: 2.5 },
    { t: 4, event: "speech.said", text: "Hello!" },
    { t: 5.5, event: "speech.finished" },
    { t: 6, event: "head.shaken" },
    { t: 7, event: "drive.stopped", reason: "done" },
    { t: 8, event: "drive.stopped", reason: "e-stop", words: "someone said stop" },
  );
  assert.deepEqual(recording.marks.map((one) => [one.row, one.from, one.to]), [["heard", 1, 2.5], ["said", 4, 5.5], ["head", 6, 6], ["body", 8, 8]]);
  assert.deepEqual(recording.lines.map((one) => one.text), ["hello", "Hello!"]);
});

test("rejected words are shown only where the recording has them", () => {
  const recording = recorded({ t: 1, event: "speech.rejected", text: "", reason: "noise" }, { t: 2, event: "speech.rejected", text: "secret", reason: "noise" });
  assert.deepEqual(recording.lines.map((one) => one.text), ["ignored", "secret"]);
});

test("the feeling and the mood are those at the playhead", () => {
  const recording = recorded(
    { t: 1, event: "emotion.changed", label: "fear", valence: 0, arousal: 0, dominance: 0 },
    { t: 3, event: "mood.changed", label: "bored", pleasure: 1, arousal: 0.5, dominance: -1 },
    { t: 4, event: "emotion.changed", label: "happy_for", valence: "x", arousal: null, dominance: 5 },
  );
  assert.deepEqual([0, 1, 3.9, 4].map((time) => feelingAt(recording, time)), ["", "scared", "scared", "happy for"]);
  assert.equal(moodAt(recording, 0), null);
  assert.deepEqual(moodAt(recording, 2), { time: 2, pleasure: 0.5, arousal: 0.25, dominance: -0.5 });
  assert.equal(moodAt(recording, 9)!.pleasure, 1);
});

test("odometry is left out, and a log without end does not fill the page", () => {
  const recording = recorded({ t: 0, event: "odometry" }, ...Array.from({ length: MOST_EVENTS + 5 }, (_, t) => ({ t, event: "x" })));
  assert.equal(recording.events.length, MOST_EVENTS);
  assert.ok(recording.isCut);
});

test("the last by a time is found", () => {
  const find = (time: number) => lastBy([1, 2, 2, 5], time, (one) => one);
  assert.deepEqual([0, 1, 2, 4.9, 9].map(find), [-1, 0, 2, 2, 3]);
});

test("the playhead goes on at its speed, and stands while it pauses", () => {
  const head = new Playhead();
  head.go(5, 100);
  assert.equal(head.at(110), 5);
  head.play(true, 110);
  assert.equal(head.at(112), 7);
  head.setSpeed(2, 112);
  assert.equal(head.at(113), 9);
  head.play(false, 114);
  assert.equal(head.at(200), 11);
});

test("one picture is fetched at a time, and of those that wait the newest", async () => {
  const fetched: number[] = [];
  let open = 0;
  let most = 0;
  let finish = () => {};
  const latest = new Latest<number>(async (item) => {
    most = Math.max(most, ++open);
    fetched.push(item);
    await new Promise<void>((done) => (finish = done));
    open--;
    if (item === 0) throw new Error("damaged");
  });
  for (let item = 0; item < 50; item++) latest.want(item);
  for (let turn = 0; turn < 3; turn++) {
    finish();
    await new Promise(setImmediate);
  }
  latest.want(99);
  assert.deepEqual(fetched, [0, 49, 99]);
  assert.equal(most, 1);
});

test("times and sizes are short to read", () => {
  assert.deepEqual([0, 59.9, 61, 3725].map((time) => clock(time)), ["0:00", "0:59", "1:01", "1:02:05"]);
  assert.deepEqual([73.4, 73.44, 59.99].map((time) => clock(time, 1)), ["1:13.4", "1:13.4", "0:59.9"]);
  assert.deepEqual([spoken(1), spoken(125)], ["1 second", "2 minutes 5 seconds"]);
  assert.deepEqual([10, 5.7e6, 24e6, 2e9].map(size), ["1 kB", "5.7 MB", "24 MB", "2.0 GB"]);
});
