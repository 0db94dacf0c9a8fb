import assert from "node:assert/strict";
import { readFileSync, readdirSync } from "node:fs";
import test from "node:test";
import { addBehavior, addLink, applySplices, copy, freeId, idFor, inverse, move, paste, remove, rename, setAttribute, setParameter, stretch, type Splice } from "../src/composer/edits";
import { History } from "../src/composer/history";
import { EMPTY, readNetwork, type Network } from "../src/composer/network";
import { command, plain, random } from "./plain_network";
import { PALETTE } from "./sample_palette";

const HOUSE = "../../../";
const TYPES = PALETTE.behaviors.map((one) => one.type);

function shipped(): string[] {
  const files = ["apps", "config", "docs"].flatMap((folder) => (readdirSync(HOUSE + folder, { recursive: true }) as string[]).map((name) => `${HOUSE}${folder}/${name}`));
  return files.filter((path) => path.endsWith(".xml") && readFileSync(path, "utf8").includes("<BehaviorNetwork"));
}

const CANONICAL = `<?xml version="1.0" encoding="UTF-8"?>
<!-- Adds. -->
<BehaviorNetwork name="sums" invocation_interval="1/30">
  <!-- One. -->
  <Behavior id="one" type="Hri.Constant">
    <!-- A half turn. -->
    <Parameter name="parsed_value" value="pi"/>
  </Behavior>
  <Behavior id="sum" type="Evolution.Addition"/>

  <Behavior id="scale" type="Hri.Scale"/>

  <!-- The wires. -->
  <Link from="one.value" to="sum.input"/>
  <Link from="sum.sum" to="scale.input"/>
  <Link from="scale.output" to="board.my.number"/>
  <Layout>
    <!-- On the left. -->
    <Box id="one" x="40" y="-8"/>
    <Box id="sum" x="240" y="80"/>
    <Box id="board.my.number" x="440" y="80"/>
  </Layout>
  <!-- The end. -->
</BehaviorNetwork>
`;

const DISORDERLY = `\ufeff<BehaviorNetwork invocation_interval='1/30'
    name='it&apos;s "here"' ><!-- The wires. --><Link to="scale.input" from='one.value'/>



 <Behavior type='Hri.Scale' id='scale'><Parameter value='1/3' name='factor'></Parameter>
 </Behavior><Behavior id="one" type="Hri.Constant"/><Layout><Box y="3" id='one' x='0'/></Layout><!-- a --><Layout>
 <Box id="scale" x="1" y="2"/></Layout></BehaviorNetwork><!-- late -->`;

const STARTS: Record<string, string> = {
  "a new network": EMPTY,
  "a network in canonical form": CANONICAL,
  "one with the lines of Windows": CANONICAL.replaceAll("\n", "\r\n"),
  "a disorderly one": DISORDERLY,
  "one that is all on one line": '<BehaviorNetwork><Behavior id="a" type="Hri.Minimum"/><Link from="a.minimum" to="board.x"/></BehaviorNetwork>',
};

const after = (text: string, edit: (n: Network) => Splice[]) => applySplices(text, edit(readNetwork(text)));

function changedLines(before: string, next: string): { gone: string[]; come: string[] } {
  const [old, now] = [before.split("\n"), next.split("\n")];
  return { gone: old.filter((line) => !now.includes(line)), come: now.filter((line) => !old.includes(line)) };
}

test("every shipped network is the same bytes as long as nothing is edited, and after an edit that is undone", () => {
  const files = shipped();
  assert.ok(files.length > 20, `${files.length} files`);
  for (const path of files) {
    const bytes = readFileSync(path);
    const history = new History(bytes.toString("utf8"));
    assert.equal(history.error, null, path);
    assert.ok(history.network!.behaviors.length > 0, path);
    history.apply(addBehavior(history.network!, { id: "new", type: "Hri.Minimum" }, { x: 1, y: 2 }), "add");
    history.apply(remove(history.network!, [history.network!.behaviors[0]!.id], []), "remove");
    history.undo();
    history.undo();
    assert.deepEqual(Buffer.from(history.text, "utf8"), bytes, path);
  }
});

test("what is added and then removed leaves the bytes of every shipped network", () => {
  for (const path of shipped()) {
    const text = readFileSync(path, "utf8");
    const added = after(text, (n) => addBehavior(n, { id: "new", type: "Hri.Minimum", parameters: [["a", "1"]] }));
    const linked = after(added, (n) => addLink(n, "new.minimum", "board.x"));
    assert.equal(after(linked, (n) => remove(n, ["new"], [])), text, path);
  }
});

test("one box moved, one parameter or attribute changed is one line changed", () => {
  const edits: [string, (n: Network) => Splice[]][] = [
    ['    <Box id="one" x="41" y="-8"/>', (n) => move(n, new Map([["one", { x: 41.4, y: -8 }], ["sum", { x: 240, y: 80 }]]))],
    ['    <Parameter name="parsed_value" value="1 &lt; 2"/>', (n) => setParameter(n, "one", "parsed_value", "1 < 2")],
    ['<BehaviorNetwork name="sums" invocation_interval="0.1">', (n) => setAttribute(n, "invocation_interval", "0.1")],
  ];
  for (const [line, edit] of edits) {
    const { gone, come } = changedLines(CANONICAL, after(CANONICAL, edit));
    assert.equal(gone.length, 1);
    assert.deepEqual(come, [line]);
  }
  assert.deepEqual(move(readNetwork(CANONICAL), new Map([["one", { x: 40, y: -8 }]])), [], "a box that stays");
  assert.deepEqual(setParameter(readNetwork(CANONICAL), "one", "parsed_value", "pi"), [], "a value that stays");
});

test("a first behavior, link and box make the file that a person would write", () => {
  let text = after(EMPTY, (n) => addBehavior(n, { id: "three", type: "Hri.Constant", parameters: [["parsed_value", "3"]] }, { x: 40, y: 120 }));
  text = after(text, (n) => addBehavior(n, { id: "show", type: "Hri.InputCollector" }, { x: 240, y: 120 }));
  text = after(text, (n) => addLink(n, "three.value", "show.input"));
  assert.equal(text, `<?xml version="1.0" encoding="UTF-8"?>
<BehaviorNetwork>
  <Behavior id="three" type="Hri.Constant">
    <Parameter name="parsed_value" value="3"/>
  </Behavior>
  <Behavior id="show" type="Hri.InputCollector"/>
  <Link from="three.value" to="show.input"/>
  <Layout>
    <Box id="three" x="40" y="120"/>
    <Box id="show" x="240" y="120"/>
  </Layout>
</BehaviorNetwork>
`);
  assert.equal(after(text, (n) => remove(n, ["three", "show"], [])), EMPTY);
});

test("what is removed takes its links, its place, and the blank line that would be one too many", () => {
  const text = after(CANONICAL, (n) => remove(n, ["scale", "board.my.number"], []));
  assert.deepEqual(changedLines(CANONICAL, text).come, []);
  assert.equal(changedLines(CANONICAL, text).gone.length, 4);
  assert.doesNotMatch(text, /\n\n\n/);
  assert.match(text, /type="Evolution.Addition"\/>\n\n  <!-- The wires. -->/);
});

test("a rename is one in links and layout as well, and leaves those whose names only begin alike", () => {
  const text = CANONICAL.replaceAll('"sum"', '"one2"').replaceAll('"sum.', '"one2.');
  const network = readNetwork(after(text, (n) => rename(n, "one", "first")));
  assert.deepEqual(network.behaviors.map((one) => one.id), ["first", "one2", "scale"]);
  assert.deepEqual(network.links.map((one) => one.from), ["first.value", "one2.sum", "scale.output"]);
  assert.deepEqual([...network.boxes.keys()], ["first", "one2", "board.my.number"]);
});

test("a rename takes no place that a part left behind", () => {
  const text = CANONICAL.replace('<Box id="sum"', '<Box id="gone"');
  const network = readNetwork(after(text, (n) => rename(n, "one", "gone")));
  assert.deepEqual(network.boxes.get("gone"), { x: 40, y: -8 });
});

test("values of every kind come back as they were given", () => {
  for (const value of ["a & b", "<\">'", "two\nlines\tand\rmore", "&amp;", "ä→🤖", " spaces ", ""])
    for (const [name, start] of Object.entries({ ...STARTS, single: CANONICAL.replaceAll('"', "'") })) {
      const text = after(start, (n) => setAttribute(n, "name", value));
      assert.equal(readNetwork(text).name, value, name);
      const added = after(text, (n) => addBehavior(n, { id: "new", type: "T", parameters: [["p", value]] }));
      assert.equal(readNetwork(added).behaviors.find((one) => one.id === "new")!.parameters.get("p"), value, name);
    }
  assert.equal(readNetwork(after(EMPTY, (n) => setAttribute(n, "name", "a\0b\x1b"))).name, "ab", "XML cannot say them");
});

test("places are whole pixels that a layout can say", () => {
  const boxes = new Map([["one", { x: -0.4, y: 1e9 }], ["sum", { x: NaN, y: -1e9 }]]);
  const network = readNetwork(after(CANONICAL, (n) => move(n, boxes)));
  assert.deepEqual([network.boxes.get("one"), network.boxes.get("sum")], [{ x: 0, y: 999999 }, { x: 0, y: -999999 }]);
});

test("ids are short and free", () => {
  assert.deepEqual(["Hri.SimpleCamera", "Hri.FGDReader", "My.x-y", "Hri.Camera2D"].map(idFor), ["simple_camera", "fgd_reader", "x_y", "camera2_d"]);
  const network = readNetwork(CANONICAL);
  assert.deepEqual(["one", "new", "board"].map((wish) => freeId(network, wish)), ["one2", "new", "board2"]);
});

test("a copy is a network of its own, and is pasted under ids that are free, as often as one likes", () => {
  const copied = copy(readNetwork(CANONICAL), ["one", "sum"]);
  assert.deepEqual(plain(readNetwork(copied)).links, ["one.value -> sum.input"]);
  const first = paste(readNetwork(CANONICAL), copied, { x: 10, y: 20 });
  assert.deepEqual(first.ids, ["one2", "sum2"]);
  const text = applySplices(CANONICAL, first.splices);
  const network = readNetwork(text);
  assert.deepEqual(network.boxes.get("sum2"), { x: 250, y: 100 });
  assert.deepEqual(network.links.at(-1), { ...network.links.at(-1)!, from: "one2.value", to: "sum2.input" });
  assert.deepEqual(paste(network, copied, { x: 0, y: 0 }).ids, ["one3", "sum3"]);
  assert.throws(() => paste(network, "no XML", { x: 0, y: 0 }), /text outside/);
  assert.deepEqual(paste(network, EMPTY, { x: 0, y: 0 }), { splices: [], ids: [] });
});

test("splices have an inverse, and a stretch is where two texts differ", () => {
  const splices = [{ from: 0, to: 0, insert: "xx" }, { from: 2, to: 4, insert: "" }, { from: 5, to: 6, insert: "yyy" }];
  const made = applySplices("abcdefg", splices);
  assert.equal(made, "xxabeyyyg");
  assert.equal(applySplices(made, inverse("abcdefg", splices)), "abcdefg");
  assert.deepEqual(stretch("aaa", "aaaa"), { from: 3, to: 3, insert: "a" });
});

/** All but those inside of a behavior, which go with it. */
const comments = (text: string) => (text.replace(/<Behavior [^>]*[^/]>.*?<\/Behavior>/gs, "").match(/<!--.*?-->/gs) ?? []).sort();

for (const [name, start] of Object.entries(STARTS))
  test(`2,000 random commands from ${name} are what they mean, and can all be undone and done again`, () => {
    const chance = random(name.length);
    const history = new History(start);
    const model = plain(history.network!);
    for (let number = 0; number < 2000; number++) {
      const { label, splices, change } = command(history.network!, PALETTE, TYPES, chance);
      const before = history.text;
      assert.ok(splices.every((one, at) => one.from <= one.to && one.from >= (splices[at - 1]?.to ?? 0)), `${label}: in order`);
      history.apply(splices, label);
      change(model);
      assert.equal(history.error, null, `${label}\n${before}`);
      assert.deepEqual(plain(history.network!), { ...model }, `${label}\n${before}`);
      assert.deepEqual(comments(history.text), comments(start), label);
      if (chance() < 0.1) {
        const now = history.text;
        for (let steps = Math.floor(chance() * 5); steps > 0 && history.undo() !== null; steps--);
        while (history.redo() !== null);
        assert.equal(history.text, now);
      }
    }
    const end = history.text;
    while (history.undo() !== null);
    assert.equal(history.text, start);
    assert.equal(history.isDirty, false);
    while (history.redo() !== null);
    assert.equal(history.text, end);
  });
