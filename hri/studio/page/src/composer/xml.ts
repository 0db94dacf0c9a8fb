// Reads XML without losing where anything stands, so that an edit can touch it alone.

export interface Attribute {
  name: string;
  value: string;
  /** Offsets in the text: all of `name="value"`, and what is between the quotes. */
  from: number;
  to: number;
  valueFrom: number;
  valueTo: number;
}

export interface Element {
  tag: string;
  attributes: Attribute[];
  children: Element[];
  parent: Element | null;
  from: number;
  to: number;
  /** Behind the opening tag, and before the closing one; both are `to` where it closes itself. */
  openTo: number;
  closeFrom: number;
}

export class XmlError extends Error {
  readonly line: number;
  readonly column: number;

  constructor(what: string, text: string, readonly offset: number) {
    super(what);
    const before = text.slice(0, offset);
    this.line = before.split("\n").length;
    this.column = offset - before.lastIndexOf("\n");
  }
}

const DEEPEST = 64;
const MOST_ELEMENTS = 50_000;
/** What no XML may have, written out or as a number. */
const FORBIDDEN = /[\0-\x08\x0b\x0c\x0e-\x1f\ufffe\uffff]/;
const LETTER = String.raw`A-Za-z_:\u00c0-\u00d6\u00d8-\u00f6\u00f8-\u02ff\u0370-\u037d\u037f-\u1fff\u200c\u200d\u2070-\u218f\u2c00-\u2fef\u3001-\ud7ff\uf900-\ufdcf\ufdf0-\ufefe`;
const WORD = String.raw`[${LETTER}][-.0-9\u00b7\u0300-\u036f\u203f\u2040${LETTER}]*`;
const SPACE = "[ \\t\\r\\n]";
const NAME = new RegExp(WORD, "y");
const SPACES = new RegExp(`${SPACE}*`, "y");
const ATTRIBUTE = new RegExp(`${SPACE}+(${WORD})${SPACE}*=${SPACE}*(?:"([^"<]*)"|'([^'<]*)')`, "y");
const DECLARATION = /^<\?xml[ \t\r\n]+version[ \t\r\n]*=[ \t\r\n]*["'][\w.]+["']([ \t\r\n]+(encoding|standalone)[ \t\r\n]*=[ \t\r\n]*["'][-\w.]+["']){0,2}[ \t\r\n]*\?>/;
const ENTITIES: Record<string, string> = { lt: "<", gt: ">", amp: "&", quot: '"', apos: "'" };

/** The root element. Raises XmlError where the text is not well-formed, or has a DOCTYPE. */
export function parseXml(text: string): Element {
  let at = text.startsWith("\ufeff") ? 1 : 0;
  let root: Element | null = null;
  let open: Element | null = null;
  let depth = 0;
  let count = 0;
  const fail = (what: string, where = at): never => {
    throw new XmlError(what, text, where);
  };
  const skipTo = (end: string, what: string, start = at): void => {
    const found = text.indexOf(end, start);
    if (found < 0) fail(`${what} is not closed`);
    at = found + end.length;
  };
  const wrong = text.search(FORBIDDEN);
  if (wrong >= 0) fail("a character that XML does not have", wrong);
  while (at < text.length) {
    const next = text.indexOf("<", at);
    const between = text.slice(at, next < 0 ? text.length : next);
    const outside = open === null ? between.search(/[^ \t\r\n]/) : -1;
    if (outside >= 0) fail("there is text outside of the root", at + outside);
    if (between.includes("&")) decode(between, text, at);
    if (between.includes("]]>")) fail("]]> has no place in a text", at + between.indexOf("]]>"));
    if (next < 0) break;
    at = next;
    if (text.startsWith("<!--", at)) {
      const from = at;
      skipTo("-->", "a comment", from + 4);
      if (text.slice(from + 4, at - 2).includes("--")) fail("a comment may not have -- in it", from);
    }
    else if (text.startsWith("<?", at)) {
      const from = at;
      const name = nameAt(text, at + 2);
      skipTo("?>", "an instruction");
      const isDeclaration = name.toLowerCase() === "xml";
      if (name === "" || !/[ \t\r\n?]/.test(text[from + 2 + name.length]!)) fail("an instruction without a name", from);
      if (isDeclaration && (!isStart(text, from) || !DECLARATION.test(text.slice(from, at)))) fail("the XML declaration is not as it must be", from);
    }
    else if (text.startsWith("<![CDATA[", at) && open !== null) skipTo("]]>", "a CDATA section");
    else if (text.startsWith("<!DOCTYPE", at)) fail("a DOCTYPE is not allowed");
    else if (text.startsWith("</", at)) {
      const from = at;
      at += 2;
      const tag = nameAt(text, at);
      at += tag.length;
      at = behindSpaces(text, at);
      if (text[at] !== ">") fail("a closing tag is not closed", from);
      at++;
      if (open === null || open.tag !== tag) fail(open === null ? `</${tag}> closes nothing` : `</${tag}> closes <${open.tag}>`, from);
      const closed: Element = open!;
      closed.closeFrom = from;
      closed.to = at;
      open = closed.parent;
      depth--;
    } else {
      const element = openingTag(text, at, open);
      if (open === null && root !== null) fail("there is more than one root");
      if (++count > MOST_ELEMENTS) fail("there are too many elements");
      open?.children.push(element);
      root ??= element;
      at = element.openTo;
      if (element.to !== element.openTo) {
        open = element;
        if (++depth > DEEPEST) fail("elements are nested too deep");
      }
    }
  }
  if (open !== null) fail(`<${open.tag}> is not closed`, open.from);
  return root ?? fail("there is no element in it", text.length);
}

function isStart(text: string, at: number): boolean {
  return at === (text.startsWith("\ufeff") ? 1 : 0);
}

function behindSpaces(text: string, at: number): number {
  SPACES.lastIndex = at;
  SPACES.exec(text);
  return SPACES.lastIndex;
}

function nameAt(text: string, at: number): string {
  NAME.lastIndex = at;
  return NAME.exec(text)?.[0] ?? "";
}

function openingTag(text: string, from: number, parent: Element | null): Element {
  const tag = nameAt(text, from + 1);
  if (tag === "") throw new XmlError("a tag without a name", text, from);
  let at = from + 1 + tag.length;
  const attributes: Attribute[] = [];
  const names = new Set<string>();
  for (;;) {
    ATTRIBUTE.lastIndex = at;
    const found = ATTRIBUTE.exec(text);
    if (found === null) break;
    const name = found[1]!;
    const raw = found[2] ?? found[3]!;
    at = ATTRIBUTE.lastIndex;
    const start = at - found[0].trimStart().length;
    const valueTo = at - 1;
    const valueFrom = valueTo - raw.length;
    if (names.has(name)) throw new XmlError(`"${name}" is there twice`, text, start);
    names.add(name);
    attributes.push({ name, value: decode(raw, text, valueFrom), from: start, to: at, valueFrom, valueTo });
  }
  at = behindSpaces(text, at);
  const isEmpty = text.startsWith("/>", at);
  if (!isEmpty && text[at] !== ">") throw new XmlError(`the tag <${tag}> is not closed`, text, from);
  at += isEmpty ? 2 : 1;
  // Where it does not close itself, `to` is known at the closing tag.
  return { tag, attributes, children: [], parent, from, to: isEmpty ? at : -1, openTo: at, closeFrom: at };
}

function decode(raw: string, text: string, offset: number): string {
  const spaced = raw.replace(/\r\n?|[\t\n]/g, " ");
  if (!raw.includes("&")) return spaced;
  let decoded = "";
  let from = 0;
  // One at a time: `replace` would find all of a megabyte before it asks for the first.
  for (const { 0: whole, 1: name = "", index } of spaced.matchAll(/&([^;&\s]*;?)/g)) {
    const letter = character(name);
    if (letter === undefined) throw new XmlError(`"${whole}" is not a character of XML - write &amp; for &`, text, offset + index);
    decoded += spaced.slice(from, index) + letter;
    from = index + whole.length;
  }
  return decoded + spaced.slice(from);
}

/** What a reference stands for, given without its "&"; undefined where XML does not allow it. */
function character(name: string): string | undefined {
  const number = /^#(?:x([0-9a-fA-F]{1,6})|(\d{1,7}));$/.exec(name);
  if (number === null) return name.endsWith(";") ? ENTITIES[name.slice(0, -1)] : undefined;
  const code = number[1] ? parseInt(number[1], 16) : Number(number[2]);
  const letter = code <= 0x10ffff && (code < 0xd800 || code > 0xdfff) ? String.fromCodePoint(code) : "\0";
  return FORBIDDEN.test(letter) ? undefined : letter;
}

export function attribute(element: Element, name: string): string | undefined {
  return element.attributes.find((one) => one.name === name)?.value;
}

const ESCAPES: Record<string, string> = { "&": "&amp;", "<": "&lt;", ">": "&gt;", '"': "&quot;" };

/** A value for between double quotes, as `hri network format` writes it, without what XML cannot say. */
export function escape(value: string): string {
  return value.replace(new RegExp(FORBIDDEN, "g"), "").replace(/[&<>"\t\n\r]/g, (letter) => ESCAPES[letter] ?? `&#${letter.charCodeAt(0)};`);
}
