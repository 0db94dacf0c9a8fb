// What the page's model makes of a file of questions, for tests/studio/composer/test_page_edits.py,
// which compares it with the rules of `hri network`.

import { readFileSync } from "node:fs";
import { compare } from "../src/composer/difference";
import { applySplices } from "../src/composer/edits";
import { readNetwork } from "../src/composer/network";
import { canLink, type Palette } from "../src/composer/wiring";
import { parseXml, XmlError, type Element } from "../src/composer/xml";
import { command, random } from "./plain_network";

interface Questions {
  palette: Palette;
  /** Random commands, one after the other. */
  edits?: { text: string; types: string[]; seed: number; count: number }[];
  /** Whether outputs may be linked to inputs. */
  links?: { text: string; pairs: [string, string][] }[];
  /** What a text has, as XML. */
  texts?: string[];
  /** How two networks differ. */
  differences?: [string, string][];
}

function edited(palette: Palette, { text, types, seed, count }: NonNullable<Questions["edits"]>[number]): [string, string][] {
  const chance = random(seed);
  return Array.from({ length: count }, () => {
    const { label, splices } = command(readNetwork(text), palette, types, chance);
    text = applySplices(text, splices);
    return [label, text];
  });
}

type Tree = [string, Record<string, string>, Tree[]];

function tree({ tag, attributes, children }: Element): Tree {
  return [tag, Object.fromEntries(attributes.map(({ name, value }) => [name, value])), children.map(tree)];
}

function parsed(text: string): Tree | string {
  try {
    return tree(parseXml(text));
  } catch (error) {
    if (error instanceof XmlError) return error.message;
    throw error;
  }
}

const { palette, edits = [], links = [], texts = [], differences = [] } = JSON.parse(readFileSync(process.argv[2]!, "utf8")) as Questions;
const answers = {
  edits: edits.map((one) => edited(palette, one)),
  links: links.map(({ text, pairs }) => pairs.map(([from, to]) => canLink(readNetwork(text), palette, from, to))),
  texts: texts.map(parsed),
  differences: differences.map(([old, next]) => compare(readNetwork(old), readNetwork(next))),
};
process.stdout.write(JSON.stringify(answers));
