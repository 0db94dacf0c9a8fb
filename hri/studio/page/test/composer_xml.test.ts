import assert from "node:assert/strict";
import test from "node:test";
import { readNetwork } from "../src/composer/network";
import { attribute, escape, parseXml, XmlError, type Element } from "../src/composer/xml";
import { inTurns, large, milliseconds, random } from "./plain_network";

test("each element and attribute has its place in the text", () => {
  const text = `\ufeff<?xml version="1.0"?>\r\n<!-- a <b> --><a x='1' yy = "&lt;2"\n>text<b/><c z="">\n</c ></a>\n<!-- end -->`;
  const root = parseXml(text);
  const [b, c] = root.children as [Element, Element];
  assert.deepEqual([text.slice(b.from, b.to), text.slice(c.from, c.to), text.slice(c.openTo, c.closeFrom)], ["<b/>", '<c z="">\n</c >', "\n"]);
  assert.deepEqual([b.openTo, b.closeFrom], [b.to, b.to]);
  assert.equal(text.slice(root.from, root.to), text.slice(text.indexOf("<a"), text.indexOf("\n<!-- end")));
  assert.deepEqual(root.attributes.map((one) => text.slice(one.from, one.to)), ["x='1'", 'yy = "&lt;2"']);
  assert.deepEqual(root.attributes.map((one) => text.slice(one.valueFrom, one.valueTo)), ["1", "&lt;2"]);
  assert.deepEqual([attribute(root, "yy"), attribute(root, "z"), b.parent], ["<2", undefined, root]);
});

test("values are read as XML means them", () => {
  const value = (raw: string) => attribute(parseXml(`<a b="${raw}"/>`), "b");
  assert.equal(value("&lt;&gt;&amp;&quot;&apos;&#65;&#x42;&#x1F916;"), "<>&\"'AB🤖");
  assert.equal(value("one\r\ntwo\nthree\tfour"), "one two three four");
  assert.equal(value("&#10;&amp;lt;"), "\n&lt;");
  for (const text of ["<&>\"'", "a\nb\tc\rd", "ä→🤖", ""]) assert.equal(value(escape(text)), text);
});

const MISTAKES: [string, string, number, number][] = [
  ["", "there is no element in it", 1, 1],
  ["<a>\n <b>\n</a>", "</a> closes <b>", 3, 1],
  ["<a>\n  <b>", "<b> is not closed", 2, 3],
  ["<a/>\n<b/>", "there is more than one root", 2, 1],
  ["<a/> x", "there is text outside of the root", 1, 6],
  ["</a>", "</a> closes nothing", 1, 1],
  ['<a b="1" b="2"/>', '"b" is there twice', 1, 10],
  ["<a b=1/>", "the tag <a> is not closed", 1, 1],
  ['<a b="1/>', "the tag <a> is not closed", 1, 1],
  ['<a\n b="&nope;"/>', '"&nope;" is not a character of XML - write &amp; for &', 2, 5],
  ['<a b="&#0;"/>', '"&#0;" is not a character of XML - write &amp; for &', 1, 7],
  ['<a b="&#xD800;"/>', '"&#xD800;" is not a character of XML - write &amp; for &', 1, 7],
  ["<a>AT&T</a>", '"&T" is not a character of XML - write &amp; for &', 1, 6],
  ["<a>\n<!-- b</a>", "a comment is not closed", 2, 1],
  ["<a><!-- b -- c --></a>", "a comment may not have -- in it", 1, 4],
  ["<a>]]></a>", "]]> has no place in a text", 1, 4],
  ["<a><?b</a>", "an instruction is not closed", 1, 4],
  ["<a><? b?></a>", "an instruction without a name", 1, 4],
  ["<?xml encoding='UTF-8'?><a/>", "the XML declaration is not as it must be", 1, 1],
  ["<!-- b --><?xml version='1.0'?><a/>", "the XML declaration is not as it must be", 1, 11],
  ["<a\u00a0b='1'/>", "the tag <a> is not closed", 1, 1],
  ["<a>\x01</a>", "a character that XML does not have", 1, 4],
  ["<a>< b/></a>", "a tag without a name", 1, 4],
  ["<!DOCTYPE a [<!ENTITY b SYSTEM 'file:///etc/passwd'>]><a>&b;</a>", "a DOCTYPE is not allowed", 1, 1],
  ["<a>".repeat(65) + "</a>".repeat(65), "elements are nested too deep", 1, 196],
];

test("a mistake has a place and words", () => {
  for (const [text, what, line, column] of MISTAKES)
    assert.throws(() => parseXml(text), (error) => {
      assert.ok(error instanceof XmlError, String(error));
      assert.deepEqual([error.message, error.line, error.column], [what, line, column], text.slice(0, 60));
      return true;
    });
});

test("a network that a check would refuse can be read", () => {
  const network = readNetwork('<Other><Behavior/><Behavior id="a"/><Behavior id="a" type="T"><Parameter/><Parameter name="n"/></Behavior><Link/><Layout><Box/><Box id="b" x="1.5" y="2"/><Box id="c" x="1" y="-2"/></Layout></Other>');
  assert.deepEqual(network.behaviors.map((one) => [one.id, one.type]), [["", ""], ["a", ""], ["a", "T"]]);
  assert.deepEqual([...network.behaviors[2]!.parameters], [["", ""], ["n", ""]]);
  assert.deepEqual(network.links.map((one) => [one.from, one.to]), [["", ""]]);
  assert.deepEqual([...network.boxes], [["c", { x: 1, y: -2 }]]);
});

const MEGABYTE = 1_000_000;
const fill = (text: string) => text.repeat(Math.ceil(MEGABYTE / text.length));

test("a megabyte of anything is read or refused within a second", () => {
  const chance = random(1);
  const letters = "<>/=\"'&;!-?[] \n\tab\u00e4\ud83e\0";
  const noise = Array.from({ length: MEGABYTE }, () => letters[Math.floor(chance() * letters.length)]).join("");
  const attributes = Array.from({ length: 120_000 }, (_, at) => `a${at}=""`).join(" ");
  const texts = {
    noise,
    "noise in an element": `<a>${noise}`,
    "noise in a value": `<a b="${noise.replaceAll(/["<]/g, "")}"/>`,
    "many attributes": `<a ${attributes}/>`,
    "many elements": `<a>${fill("<b/>")}</a>`,
    "open tags": fill("<a>"),
    "opening letters": fill("<"),
    "open tags and values": fill('<a b="'),
    "a long name": `<${fill("a")}`,
    "a long space": `<a${fill(" ")}`,
    "a long space before =": `<a b${fill(" ")}`,
    "a long space behind =": `<a b=${fill(" ")}`,
    "an open value": `<a b="${fill("x")}`,
    "ampersands": `<a b="${fill("&")}"/>`,
    "entities": `<a b="${fill("&amp;")}"/>`,
    "an endless entity": `<a b="&${fill("x")}"/>`,
    "open comments": `<a>${fill("<!--")}`,
    "comments": `<a>${fill("<!-- -->")}</a>`,
    "lines": `<a>${fill("\n")}`,
    "behaviors alike": `<a>${fill('<Behavior id="a"/>')}</a>`,
  };
  for (const [name, text] of Object.entries(texts)) {
    const took = milliseconds(() => {
      try {
        readNetwork(text);
      } catch (error) {
        assert.ok(error instanceof XmlError, `${name}: ${error}`);
      }
    }, 1);
    assert.ok(took < 1000, `${name}: ${took.toFixed(0)} ms`);
  }
});

/** The time to read a text, in that to find its words: 3 to 5 on any machine, where the second takes 0.7 to 1.3 ms. */
const MOST_TIMES = 7;

test("a network of 300 behaviors is read about as fast as its words can be found", () => {
  const text = large(300);
  assert.equal(readNetwork(text).behaviors.length, 300);
  const [took = 0, words = 0] = inTurns([() => readNetwork(text), () => [...text.matchAll(/[^\s<>="]+/g)].length]);
  console.log(`reading 300 behaviors, 598 links, 300 boxes: ${took.toFixed(2)} ms, finding its words: ${words.toFixed(2)} ms`);
  assert.ok(took < MOST_TIMES * words, `${took} ms, ${words} ms`);
});
