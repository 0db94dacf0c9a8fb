// What the page's model makes of a file of questions, for tests/studio/composer/test_page_edits.py,
// which compares it with the rules of `hri network`.

import { readFileSync } from "node:fs";
import { compare } from "../src/composer/difference";
import { applySplices } from "../src/composer/edits";
import { readNetwork, type Network } from "../src/composer/network";
import { canLink, type Palette } from "../src/composer/wiring";
import { parseXml, XmlError, type Element } from "../src/composer/xml";
import { command, random } from "./plain_network";

interface Questions {
  palette: Omit<Palette, "datatypes">;
  /** Datatypes of constants by their values, as the robot reads these. */
  constants: Record<string, string>;
  /** Random commands, one after the other. */
  edits?: { text: string; types: string[]; seed: number; count: number }[];
  /** Whether outputs may be linked to inputs. */
  links?: { text: string; pairs: [string, string][] }[];
  /** What a text has, as XML. */
  texts?: string[];
  /** How two networks differ. */
  differences?: [string, string][];
}

function edited({ text, types, seed, count }: NonNullable<Questions["edits"]>[number]): [string, string][] {
  const chance = random(seed);
  return Array.from({ length: count }, () => {
    const network = readNetwork(text);
    const { label, splices } = command(network, paletteFor(network), types, chance);
    text = applySplices(text, splices);
    return [label, text];
  });
}

/** The palette, with what the robot says of the constants of a network. */
function paletteFor({ behaviors }: Network): Palette {
  const values = behaviors.filter((one) => one.type.endsWith(".Constant")).map((one) => [`${one.id}.value`, constants[one.parameters.get("parsed_value") ?? "0"] ?? "any"]);
  return { ...palette, datatypes: Object.fromEntries(values) };
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

const { palette, constants, edits = [], links = [], texts = [], differences = [] } = JSON.parse(readFileSync(process.argv[2]!, "utf8")) as Questions;
const answers = {
  edits: edits.map(edited),
  links: links.map(({ text, pairs }) => pairs.map(([from, to]) => canLink(readNetwork(text), paletteFor(readNetwork(text)), from, to))),
  texts: texts.map(parsed),
  differences: differences.map(([old, next]) => compare(readNetwork(old), readNetwork(next))),
};
process.stdout.write(JSON.stringify(answers));
