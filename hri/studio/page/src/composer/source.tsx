// The XML beside the graph, either of which can be edited. The page forbids style elements, so the
// editor lives in a shadow root, where it takes constructed style sheets.

import { defaultKeymap } from "@codemirror/commands";
import { xml } from "@codemirror/lang-xml";
import { HighlightStyle, indentUnit, syntaxHighlighting } from "@codemirror/language";
import { lintGutter, setDiagnostics } from "@codemirror/lint";
import { highlightSelectionMatches, searchKeymap } from "@codemirror/search";
import { Annotation, EditorState } from "@codemirror/state";
import { drawSelection, EditorView, highlightActiveLine, keymap, lineNumbers } from "@codemirror/view";
import { tags } from "@lezer/highlight";
import { useEffect, useRef } from "react";
import type { ComposerDocument } from "./document";
import { stretch } from "./edits";
import { useStore } from "./store";

/** Marks changes that came from the graph, which must not go back to it. */
const FromGraph = Annotation.define<boolean>();
const COLORS = HighlightStyle.define([
  { tag: tags.tagName, color: "var(--wire-2)" },
  { tag: tags.attributeName, color: "var(--wire-0)" },
  { tag: tags.attributeValue, color: "var(--wire-4)" },
  { tag: tags.comment, color: "var(--quiet)" },
]);

const THEME = EditorView.theme({
  "&": { height: "100%", color: "var(--text)", backgroundColor: "var(--card)", fontSize: "13px" },
  ".cm-scroller": { fontFamily: "ui-monospace, monospace", overflow: "auto" },
  ".cm-gutters": { backgroundColor: "var(--ground)", color: "var(--quiet)", border: "none" },
  ".cm-activeLine, .cm-activeLineGutter": { backgroundColor: "var(--mark)" },
  ".cm-cursor": { borderLeftColor: "var(--text)" },
  ".cm-content": { caretColor: "var(--text)" },
  // The marks that come with the editor are images in style sheets, which the page forbids.
  ".cm-lint-marker": { width: "0.8em", height: "0.8em", margin: "0.2em auto 0" },
  ".cm-lint-marker-error": { content: "normal", backgroundColor: "var(--wrong)", borderRadius: "50%" },
  ".cm-lint-marker-warning": { content: "normal", backgroundColor: "var(--doubt)", clipPath: "polygon(50% 0, 100% 100%, 0 100%)" },
  ".cm-lintRange": { backgroundImage: "none", textDecorationLine: "underline", textDecorationStyle: "wavy", textDecorationSkipInk: "none" },
  ".cm-lintRange-error": { backgroundImage: "none", textDecorationColor: "var(--wrong)" },
  ".cm-lintRange-warning": { backgroundImage: "none", textDecorationColor: "var(--doubt)" },
});

export function Source({ doc }: { doc: ComposerDocument }) {
  const host = useRef<HTMLDivElement>(null);
  const view = useRef<EditorView | null>(null);
  const path = useStore(doc.path);
  const revision = useStore(doc.revision);
  const problems = useStore(doc.problems);
  const { ids } = useStore(doc.selection);

  useEffect(() => {
    const root = host.current!.shadowRoot ?? host.current!.attachShadow({ mode: "open" });
    const editor = new EditorView({
      root,
      parent: root,
      state: EditorState.create({
        doc: doc.history.text,
        extensions: [
          EditorState.lineSeparator.of("\n"),
          lineNumbers(),
          lintGutter(),
          drawSelection(),
          highlightActiveLine(),
          EditorView.lineWrapping,
          highlightSelectionMatches(),
          indentUnit.of("  "),
          xml(),
          syntaxHighlighting(COLORS),
          // Undo is the document's, so that the graph and the text have one history.
          keymap.of([
            { key: "Mod-z", run: () => (doc.undo(), true) },
            { key: "Mod-y", run: () => (doc.redo(), true) },
            { key: "Mod-Shift-z", run: () => (doc.redo(), true) },
            ...searchKeymap,
            ...defaultKeymap,
          ]),
          EditorView.contentAttributes.of({ "aria-label": "The network as XML" }),
          THEME,
          EditorView.updateListener.of((update) => {
            if (!update.docChanged || update.transactions.some((one) => one.annotation(FromGraph))) return;
            const splices: { from: number; to: number; insert: string }[] = [];
            update.changes.iterChanges((from, to, _a, _b, inserted) => splices.push({ from, to, insert: inserted.toString() }));
            doc.apply(splices, "edit the XML", "xml");
          }),
        ],
      }),
    });
    editor.scrollDOM.tabIndex = 0; // so that the keyboard can scroll it
    view.current = editor;
    return () => editor.destroy();
  }, [doc, path]);

  useEffect(() => {
    const editor = view.current!;
    const [before, after] = [editor.state.doc.toString(), doc.history.text];
    if (before === after) return;
    const { from, to, insert } = stretch(before, after);
    editor.dispatch({ changes: { from, to, insert }, annotations: FromGraph.of(true) });
  }, [doc, revision]);

  useEffect(() => {
    const editor = view.current!;
    const { doc: text } = editor.state;
    const found = problems.filter((one) => one.line <= text.lines).map((one) => {
      const line = text.line(Math.max(1, one.line));
      const from = Math.min(line.to, line.from + Math.max(0, one.column - 1));
      return { from, to: line.to, severity: one.grave, message: [one.what, one.remedy].filter(Boolean).join(" - ") };
    });
    editor.dispatch(setDiagnostics(editor.state, found));
  }, [problems, revision]);

  useEffect(() => {
    const editor = view.current!;
    const behavior = ids.size === 1 ? doc.network.behaviors.find((one) => ids.has(one.id)) : undefined;
    if (!behavior || editor.hasFocus || doc.history.error) return;
    editor.dispatch({ selection: { anchor: behavior.element.from }, effects: EditorView.scrollIntoView(behavior.element.from, { y: "center" }) });
  }, [doc, ids]);

  return <div className="xml-source" ref={host} />;
}
