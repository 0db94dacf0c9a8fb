// What is selected, to be changed: a behavior's parameters and links; with nothing selected the
// network's own.

import { useEffect, useId, useState, type KeyboardEvent, type ReactNode } from "react";
import type { ComposerDocument } from "./document";
import { addLink, remove, rename, setAttribute, setParameter } from "./edits";
import type { Behavior, Link } from "./network";
import type { Problem } from "./server";
import { useStore } from "./store";
import { behaviorKind, canLink, portsOf, type Parameter, type Port } from "./wiring";

interface PropertiesProps {
  doc: ComposerDocument;
  isLive: boolean;
  why(port: string): void;
  breakAt(port: string): void;
}

export function Properties(props: PropertiesProps) {
  const { doc } = props;
  useStore(doc.revision);
  useStore(doc.palette);
  const { ids, links } = useStore(doc.selection);
  const problems = useStore(doc.problems);
  const { network } = doc;
  const behaviors = network.behaviors.filter((one) => ids.has(one.id));
  if (behaviors.length === 1) return <BehaviorProperties {...props} behavior={behaviors[0]!} problems={problems.filter((one) => one.behavior === behaviors[0]!.id)} />;
  if (ids.size > 1) return <p className="quiet">{ids.size} parts are selected.</p>;
  if (ids.size === 1) return <SlotProperties {...props} id={[...ids][0]!} />;
  if (links.size > 0) return <LinkProperties doc={doc} keys={links} problems={problems} />;
  return <NetworkProperties doc={doc} problems={problems} />;
}

function NetworkProperties({ doc, problems }: { doc: ComposerDocument; problems: Problem[] }) {
  const { network } = doc;
  const order = useStore(doc.order);
  const set = (name: "name" | "invocation_interval") => (value: string) =>
    doc.apply(setAttribute(network, name, value === "" ? null : value), `set the ${name === "name" ? "name" : "interval"} of the network`);
  return (
    <>
      <h2>Network</h2>
      <Field label="Name" hint="the name of its file, if empty" value={network.name ?? ""} commit={set("name")} />
      <Field label="Interval" unit="s" hint="0.1 if empty: ten times a second; 1/30 works too" value={network.interval ?? ""} commit={set("invocation_interval")} />
      <p className="quiet">{network.behaviors.length} behaviors, {network.links.length} links</p>
      <Problems problems={problems} doc={doc} />
      {order.length > 0 ? (
        <details>
          <summary>Order in which they run</summary>
          <ol className="order">{order.map((id) => <li key={id}><button type="button" onClick={() => doc.select([id])}>{id}</button></li>)}</ol>
        </details>
      ) : null}
    </>
  );
}

export function Problems({ problems, doc }: { problems: Problem[]; doc: ComposerDocument }) {
  if (problems.length === 0) return null;
  return (
    <ul className="problems">
      {problems.map((one, number) => (
        <li key={number} className={one.grave}>
          {one.behavior ? <button type="button" onClick={() => doc.select([one.behavior!])}>{one.behavior}</button> : <span>line {one.line}</span>} {one.what}{one.remedy ? ` - ${one.remedy}` : ""}
        </li>
      ))}
    </ul>
  );
}

function BehaviorProperties({ doc, behavior, problems, isLive, why, breakAt }: PropertiesProps & { behavior: Behavior; problems: Problem[] }) {
  const { network } = doc;
  const kind = behaviorKind(doc.palette.value, behavior.type);
  const ports = portsOf(network, doc.palette.value, behavior.id);
  const { id } = behavior;
  const known = new Set(kind?.parameters.map((one) => one.name));
  const strangers = [...behavior.parameters.keys()].filter((name) => !known.has(name));
  const change = (name: string, value: string | null) => doc.apply(setParameter(network, id, name, value), `set ${id}.${name}`);
  return (
    <>
      <h2>{id}</h2>
      <p className="quiet">{behavior.type}{kind ? `: ${kind.about}` : " is not known here"}</p>
      <Problems problems={problems} doc={doc} />
      <Field
        label="Id"
        value={id}
        check={(value) => (!value || value.includes(".") ? "take a word without dots" : value !== id && network.behaviors.some((one) => one.id === value) ? "there is one of this name" : "")}
        commit={(value) => {
          doc.apply(rename(network, id, value), `rename ${id} to ${value}`);
          doc.select([value]);
        }}
      />
      {kind?.parameters.map((one) => <ParameterField key={one.name} doc={doc} parameter={one} value={behavior.parameters.get(one.name)} commit={(value) => change(one.name, value)} />)}
      {strangers.map((name) => (
        <p key={name} className="wrong">{name} is not a parameter of {behavior.type} <button type="button" onClick={() => change(name, null)}>Remove it</button></p>
      ))}
      <Ends title="Inputs" doc={doc} id={id} ports={ports.inputs} isInput isLive={isLive} why={why} breakAt={breakAt} />
      <Ends title="Outputs" doc={doc} id={id} ports={ports.outputs} isInput={false} isLive={isLive} why={why} breakAt={breakAt} />
    </>
  );
}

function SlotProperties({ doc, id, isLive, why, breakAt }: PropertiesProps & { id: string }) {
  const slot = doc.palette.value.slots.find((one) => `board.${one.name}` === id);
  const links = doc.network.links.filter((one) => one.from === id || one.to === id);
  const type = slot?.datatype ?? "";
  return (
    <>
      <h2>{id}</h2>
      <p className="quiet">A slot of the board{type ? `, ${type}` : ""}{slot?.about ? `: ${slot.about}` : ""}. All networks of the robot share it.</p>
      <ul className="links">{links.map((one) => <LinkRow key={`${one.from} ${one.to}`} doc={doc} link={one} words={one.from === id ? `read by ${one.to}` : `written by ${one.from}`} />)}</ul>
      {isLive ? <p className="row"><button type="button" onClick={() => why(id)}>Why this value?</button><button type="button" onClick={() => breakAt(id)}>Break when…</button></p> : null}
    </>
  );
}

function LinkProperties({ doc, keys, problems }: { doc: ComposerDocument; keys: ReadonlySet<string>; problems: Problem[] }) {
  const links = doc.network.links.filter((one) => keys.has(`${one.from} -> ${one.to}`));
  return (
    <>
      <h2>{links.length === 1 ? "Link" : `${links.length} links`}</h2>
      <ul className="links">{links.map((one) => <LinkRow key={`${one.from} ${one.to}`} doc={doc} link={one} words={`${one.from} → ${one.to}`} />)}</ul>
      <Problems problems={problems.filter((one) => one.link && keys.has(`${one.link.from} -> ${one.link.to}`))} doc={doc} />
    </>
  );
}

function LinkRow({ doc, link, words }: { doc: ComposerDocument; link: Link; words: string }) {
  return (
    <li>
      {words} <button type="button" aria-label={`Remove the link from ${link.from} to ${link.to}`} onClick={() => doc.apply(remove(doc.network, [], [link]), `remove the link from ${link.from}`)}>×</button>
    </li>
  );
}

interface EndsProps extends Omit<PropertiesProps, "doc"> {
  title: string;
  doc: ComposerDocument;
  id: string;
  ports: Port[];
  isInput: boolean;
}

/** The links of each port, and a choice of what it could be linked with: all of it by keyboard. */
function Ends({ title, doc, id, ports, isInput, isLive, why, breakAt }: EndsProps) {
  if (ports.length === 0) return null;
  const { network } = doc;
  return (
    <section className="ends" aria-label={title}>
      <h3>{title}</h3>
      {ports.map((port) => {
        const text = `${id}.${port.name}`;
        const links = network.links.filter((one) => (isInput ? one.to : one.from) === text);
        return (
          <div key={port.name} className="end">
            <p title={port.description}><b>{port.name}</b> <small>{port.datatype}{port.is_optional ? ", optional" : ""}</small></p>
            <ul className="links">{links.map((one) => <LinkRow key={`${one.from} ${one.to}`} doc={doc} link={one} words={isInput ? `from ${one.from}` : `to ${one.to}`} />)}</ul>
            <Wiring doc={doc} text={text} isInput={isInput} />
            {isLive ? <p className="row"><button type="button" onClick={() => why(text)}>Why this value?</button>{isInput ? null : <button type="button" onClick={() => breakAt(text)}>Break when…</button>}</p> : null}
          </div>
        );
      })}
    </section>
  );
}

/** A choice is linked by the button or by Enter: arrow keys go through a list without doing anything. */
function Wiring({ doc, text, isInput }: { doc: ComposerDocument; text: string; isInput: boolean }) {
  const [isOpen, setIsOpen] = useState(false);
  const [choice, setChoice] = useState("");
  const choices = isOpen ? choicesFor(doc, text, isInput) : [];
  const chosen = choices.includes(choice) ? choice : "";
  const link = () => {
    if (chosen === "") return;
    const [from, to] = isInput ? [chosen, text] : [text, chosen];
    doc.apply(addLink(doc.network, from, to), `link ${from} to ${to}`);
    setChoice("");
  };
  const key = (event: KeyboardEvent) => {
    if (event.key !== "Enter") return;
    event.preventDefault();
    link();
  };
  return (
    <p className="row wiring-choice">
      <select aria-label={`Link ${text} ${isInput ? "from" : "to"}`} value={chosen} onFocus={() => setIsOpen(true)} onPointerDown={() => setIsOpen(true)} onChange={(event) => setChoice(event.target.value)} onKeyDown={key}>
        <option value="">{isInput ? "link from…" : "link to…"}</option>
        {choices.map((one) => <option key={one}>{one}</option>)}
      </select>
      <button type="button" aria-label={chosen ? `Link ${text} ${isInput ? "from" : "to"} ${chosen}` : `Link ${text}: choose first`} disabled={chosen === ""} onClick={link}>Link</button>
    </p>
  );
}

function choicesFor(doc: ComposerDocument, text: string, isInput: boolean): string[] {
  const { network } = doc;
  const palette = doc.palette.value;
  const others = network.behaviors.flatMap(({ id }) => {
    const ports = portsOf(network, palette, id);
    return (isInput ? ports.outputs : ports.inputs).map((one) => `${id}.${one.name}`);
  });
  const slots = palette.slots.map((one) => `board.${one.name}`);
  return [...others, ...slots].filter((one) => (isInput ? canLink(network, palette, one, text) : canLink(network, palette, text, one)).ok);
}

interface ParameterProps {
  doc: ComposerDocument;
  parameter: Parameter;
  value: string | undefined;
  commit(value: string | null): void;
}

function ParameterField({ doc, parameter, value, commit }: ParameterProps) {
  const { name, type, minimum, maximum, description } = parameter;
  const bounds = [minimum === null ? "" : `from ${minimum}`, maximum === null ? "" : `to ${maximum}`].filter(Boolean).join(" ");
  const choices = parameter.interface ? doc.palette.value.devices.filter((one) => one.interface === parameter.interface).map((one) => one.id) : parameter.choices;
  return (
    <Field
      label={name}
      unit={parameter.unit}
      hint={[description, bounds].filter(Boolean).join("; ")}
      value={value ?? ""}
      placeholder={parameter.default}
      choices={type === "boolean" ? ["true", "false"] : choices}
      check={(text) => (text === "" ? "" : refusal(parameter, text))}
      commit={(text) => commit(text === "" ? null : text)}
    />
  );
}

/** Why a value cannot be taken; empty where the server decides. */
export function refusal({ type, minimum, maximum }: Parameter, text: string): string {
  if (!["number", "integer"].includes(type)) return "";
  if (!/^[-+]?(\d+\.?\d*|\.\d+)(e[-+]?\d+)?$/i.test(text.trim())) return /[a-z(/*+-]/i.test(text) ? "" : "write a number";
  const number = Number(text);
  if (minimum !== null && number < minimum) return `at least ${minimum}`;
  if (maximum !== null && number > maximum) return `at most ${maximum}`;
  return "";
}

interface FieldProps {
  label: string;
  value: string;
  unit?: string | undefined;
  hint?: string;
  placeholder?: string;
  choices?: readonly string[];
  check?(value: string): string;
  commit(value: string): void;
}

/** A line that is taken over by Enter, or when it is left; Escape gives it back. */
export function Field({ label, value, unit, hint, placeholder, choices, check, commit }: FieldProps): ReactNode {
  const [text, setText] = useState(value);
  const id = useId();
  useEffect(() => setText(value), [value]);
  const wrong = text === value ? "" : (check?.(text) ?? "");
  const done = () => {
    if (text !== value && !wrong) commit(text);
  };
  const key = (event: KeyboardEvent) => {
    if (event.key === "Enter") done();
    if (event.key === "Escape" && text !== value) setText(value);
  };
  return (
    <div className="field">
      <label htmlFor={id}>{label}{unit ? <small> {unit}</small> : null}</label>
      <input
        id={id}
        value={text}
        list={choices?.length ? `${id}-choices` : undefined}
        placeholder={placeholder}
        aria-invalid={wrong !== ""}
        aria-describedby={`${id}-hint`}
        autoComplete="off"
        spellCheck={false}
        onChange={(event) => setText(event.target.value)}
        onBlur={done}
        onKeyDown={key}
      />
      {choices?.length ? <datalist id={`${id}-choices`}>{choices.map((one) => <option key={one} value={one} />)}</datalist> : null}
      <small id={`${id}-hint`} className={wrong ? "wrong" : "quiet"}>{wrong || hint}</small>
    </div>
  );
}
