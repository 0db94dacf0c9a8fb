// The page: shows the state, and binds the commands to buttons and keys.


import { bindKeys, type Action } from "./commands";
import { Connection, type Picture } from "./connection";
import { settle, show } from "./dialog";
import { element, list, Parts, replace } from "./dom";
import { Hold } from "./hold";
import { Map } from "./map";
import { MoodCurve } from "./mood";
import { LivePicture } from "./picture";
import { RoomForm } from "./room";
import { KEYS, RecordingsView } from "./recordings_view";
import { empty, forgetEvents, matching, putCommand, summary, take, type Device, type RobotEvent, type Saying, type SeenPerson, type State, type Values } from "./state";
import { hashOf, viewOf, VIEWS } from "./views";
import type { ComposerView } from "./composer/view";

const VISITOR: [string, string, string][] = [
  ["visitor_nod", "Nod", "y"],
  ["visitor_shake", "Shake the head", "n"],
  ["visitor_enter", "Come in", "i"],
  ["visitor_leave", "Leave", "o"],
  ["bump", "Bump the robot", "b"],
];

/** Between two drawings of the values; pictures are shown as they come. */
const DRAW_MS = 80;

const state: State = empty();
const curve = new MoodCurve(element("mood-curve"), element("reasons"));
const map = new Map(
  element<SVGSVGElement>("map"),
  (what, x, y) => void ask(...putCommand(what ?? { kind: "person", name: who() }, x, y)),
  () => requestAnimationFrame(draw),
);
const roomForm = new RoomForm((command, given) => void ask(command, given));
const talk = new Hold(element<HTMLButtonElement>("hold"), (on) => void ask("talk", { on }));
const recordings = new RecordingsView();
let composer: ComposerView | null = null;
let isDrawn = true;
const parts = new Parts();
const pictures: Record<Picture, LivePicture> = {
  face: new LivePicture(element("face-picture")),
  camera: new LivePicture(element("camera-picture")),
};

const connection = new Connection({
  message(message) {
    take(state, message);
    giveBack(message);
    showNetworkAlone();
    if (!element("networks").hidden) composer?.take(state.values);
    drawSoon();
  },
  picture(which, jpeg) {
    void pictures[which].show(jpeg);
  },
  linked(isLinked, isKnown) {
    if (isLinked) forgetEvents(state); // the last ones come again
    const why = isKnown ? "no link to the robot - it comes back by itself" : "open the address that hri studio printed: this browser is not known yet";
    element("link").textContent = isLinked ? "linked" : "no link";
    document.body.classList.toggle("unlinked", !isLinked);
    say(isLinked ? "" : why);
  },
});

function ask(command: string, given: Record<string, unknown> = {}): Promise<void> {
  return told(connection.ask(command, given));
}

function stop(): void {
  void told(connection.stop());
}

/** Say what goes wrong. */
async function told(doing: Promise<unknown>): Promise<void> {
  try {
    await doing;
    say("");
  } catch (error) {
    say(error instanceof TypeError ? "no link to the robot" : (error as Error).message);
  }
}

function say(words: string): void {
  const notice = element("notice");
  notice.textContent = words;
  notice.hidden = words === "";
}

/** Values come one by one: they are drawn together, so that a busy machine has less to do. */
function drawSoon(): void {
  if (!isDrawn) return;
  isDrawn = false;
  setTimeout(
    () =>
      requestAnimationFrame(() => {
        isDrawn = true;
        draw();
      }),
    DRAW_MS,
  );
}

function draw(): void {
  drawHeader();
  if (!element("live").hidden) drawLive();
}

function drawHeader(): void {
  const { about, base } = state.values;
  const robot = element("robot");
  robot.textContent = about ? `${about.app}, ${about.is_simulated ? "simulated" : "real"}` : "";
  robot.className = about?.is_simulated ? "badge simulated" : "badge real";
  const isStopped = base?.is_stopped ?? false;
  document.body.classList.toggle("stopped", isStopped);
  element("release").hidden = !isStopped;
  element("stop").hidden = about !== undefined && !about.has_base;
}

function drawLive(): void {
  const { base, feeling, people, speech, world, devices, path, moods, log } = state.values;
  parts.draw("feeling", [feeling], () => drawFeeling(feeling));
  parts.draw("moods", [moods], () => curve.draw(moods));
  parts.draw("lines", [state.lines], drawLines);
  parts.draw("sayings", [state.values.sayings, sought()], () => drawSayings(state.values.sayings ?? []));
  parts.draw("events", [state.events], drawEvents);
  parts.draw("speech", [speech], () => drawSpeech(speech));
  parts.draw("people", [people, pictures.camera.canvas.width], () => drawPeople(people?.persons ?? [], people?.is_on ?? false));
  parts.draw("map", [world, base, path, people, map.carried], () => map.draw(world, base, path, people?.persons ?? []));
  parts.draw("base", [base], () => drawBase(base));
  parts.draw("devices", [devices], () => list(element("device-list"), devices ?? [], (one) => ({ text: one.id, detail: deviceWords(one), kind: one.state })));
  parts.draw("log", [log], () => list(element("log-lines"), [...(log ?? [])].reverse(), (one) => ({ text: one.part, detail: one.text, kind: one.level, time: one.t })));
  parts.draw("visitors", [world], () => drawVisitors(world));
}

function drawFeeling(feeling: Values["feeling"]): void {
  element("mood").textContent = feeling ? `I am ${feeling.words}` : "";
  element("why").textContent = feeling?.why ?? "";
  replace(element("emotions"), Object.entries(feeling?.emotions ?? {}).sort((a, b) => b[1] - a[1]).slice(0, 6).map(bar));
}

function drawLines(): void {
  const said = element("said");
  const isAtEnd = said.scrollHeight - said.scrollTop - said.clientHeight < 40;
  list(element("lines"), state.lines, (line) => ({ text: line.text, detail: line.detail, kind: line.who, time: line.time }));
  if (isAtEnd) said.scrollTop = said.scrollHeight;
}

/** The letters that are looked for in what can be said. */
function sought(): string {
  return element<HTMLInputElement>("seek").value;
}

/** What can be said, by rule; what is chosen is written into the field, to be sent or changed. */
function drawSayings(sayings: Saying[]): void {
  element("sayings").hidden = sayings.length === 0;
  replace(element("saying-list"), matching(sayings, sought()).map((one) => {
    const group = document.createElement("optgroup");
    group.label = one.rule.replaceAll("_", " ");
    group.title = one.about;
    group.append(...one.examples.map((text) => new Option(text)));
    return group;
  }));
}

function drawEvents(): void {
  list(element("events"), state.events.filter((one) => one.event !== "odometry").reverse(), (event) => ({ text: event.event, detail: summary(event), kind: "", time: event.t }));
}

function drawSpeech(speech: Values["speech"]): void {
  element("hearing").textContent = speech?.is_held ? "hears you" : speech?.is_muted ? "deaf" : speech?.is_speaking ? "speaks" : speech?.is_hearing ? "hears a voice" : "listens";
  press("mute", speech?.is_muted ?? false);
}

function drawBase(base: Values["base"]): void {
  const [x, y, heading] = (base?.pose ?? [0, 0, 0]) as [number, number, number];
  const place = base?.pose ? `x ${x.toFixed(2)} m, y ${y.toFixed(2)} m, ${Math.round((heading * 180) / Math.PI)}°` : "no base";
  element("where").textContent = base?.is_stopped ? `${base.why}. Release it to let it move.` : place;
  const level = base?.battery == null ? "unknown" : `${Math.round(base.battery * 100)} %`;
  element("battery").textContent = base?.has_battery ? `Battery ${level}` : "";
}

function drawVisitors(world: Values["world"]): void {
  roomForm.draw(world);
  const isPeopled = (world?.people.length ?? 0) > 0;
  for (const id of ["visitor", "visitor-sentence"]) element(id).hidden = !isPeopled;
  drawWho((world?.people ?? []).map((one) => one.name));
}

function deviceWords(device: Device): string {
  if (device.state === "missing") return `${device.problem || "missing"} - ${device.says} stands in`;
  return device.problem || device.says;
}

/** The simulated person who is asked, by name; the first without a name. */
function who(): string {
  return element<HTMLSelectElement>("who").value;
}

let drawnNames = "";

function drawWho(names: string[]): void {
  if (drawnNames === names.join()) return;
  drawnNames = names.join();
  const select = element<HTMLSelectElement>("who");
  select.replaceChildren(...names.map((name) => new Option(name || "visitor", name)));
  element("who-label").hidden = names.length < 2;
}

function askPerson(command: string, given: Record<string, unknown> = {}): void {
  const name = command === "bump" ? "" : who();
  void ask(command, name ? { ...given, who: name } : given);
}

function bar([name, value]: [string, number]): HTMLElement {
  const row = document.createElement("label");
  const meter = document.createElement("meter");
  meter.max = 1;
  meter.value = value;
  row.append(name.replaceAll("_", " "), meter);
  return row;
}

function press(id: string, isPressed: boolean): void {
  element(id).setAttribute("aria-pressed", String(isPressed));
}

/** What of someone turns to the robot. */
function view(person: SeenPerson): string {
  if (!person.has_face) return "from behind";
  return person.is_looking ? "looks at the robot" : "looks away";
}

function drawPeople(persons: SeenPerson[], isOn: boolean): void {
  const { canvas } = pictures.camera;
  const boxes = element("boxes");
  canvas.hidden = !isOn;
  boxes.setAttribute("viewBox", `0 0 ${canvas.width} ${canvas.height}`);
  press("watch", isOn);
  const found = isOn ? persons.filter((one) => one.box !== null) : [];
  replace(boxes, found.map((one) => {
    const [x, y, width, height] = one.box! as [number, number, number, number];
    const box = document.createElementNS("http://www.w3.org/2000/svg", "rect");
    for (const [name, value] of Object.entries({ x, y, width, height })) box.setAttribute(name, String(value));
    box.setAttribute("class", one.is_looking ? "looking" : one.has_face ? "" : "behind");
    return box;
  }));
  list(element("people"), persons, (one) => ({
    text: one.name || one.id,
    detail: [one.distance === null ? "" : `${one.distance.toFixed(1)} m`, view(one), one.engagement].filter(Boolean).join(", "),
    kind: one.is_attended ? "attended" : "",
  }));
}

/** The sentence that was sent last. */
let sent = "";

/** A typed sentence that is not understood comes back into its field, to be corrected. */
function giveBack(message: unknown): void {
  const { event } = message as { event?: RobotEvent };
  const input = element<HTMLInputElement>("text");
  if (sent === "" || event?.typed !== true || event.text !== sent) return;
  sent = "";
  if (input.value !== "") return;
  input.value = String(event.text);
  if (document.activeElement === input) input.select();
}

function toggle(id: string, command: string): void {
  void ask(command, { on: element(id).getAttribute("aria-pressed") !== "true" });
}

function send(field: string, command: string): void {
  const input = element<HTMLInputElement>(field);
  const text = input.value.trim();
  if (text === "") return;
  input.value = "";
  if (command === "visitor_say") askPerson(command, { text });
  else {
    if (command === "hear") sent = text;
    void ask(command, { text });
  }
}

function showKeys(): void {
  show(element<HTMLDialogElement>("help"));
}

const actions: Action[] = [
  { about: "stop the base at once", key: "Escape", always: true, run: stop },
  { about: "let the base move again", key: "r", run: () => void ask("release") },
  { about: "write a sentence to the robot", key: "/", run: () => element("text").focus() },
  { about: "hold to talk to it", key: "t", run: () => talk.begin(), end: () => talk.end() },
  { about: "let it fall silent", key: "h", run: () => void ask("hush") },
  { about: "make it deaf, or let it hear", key: "m", run: () => toggle("mute", "mute") },
  { about: "switch the camera", key: "c", run: () => toggle("watch", "watch") },
  ...VISITOR.map(([command, words, key]) => ({ about: `simulated person: ${words.toLowerCase()}`, key, run: () => askPerson(command) })),
  { about: "show the keys", key: "?", run: showKeys },
];

function bind(): void {
  const clicks: Record<string, () => void> = {
    stop,
    release: () => void ask("release"),
    mute: () => toggle("mute", "mute"),
    watch: () => toggle("watch", "watch"),
    speak: () => send("text", "say"),
    keys: showKeys,
  };
  for (const [id, run] of Object.entries(clicks)) element(id).addEventListener("click", run);
  const forms: Record<string, () => void> = {
    sentence: () => send("text", "hear"),
    "visitor-sentence": () => send("visitor-text", "visitor_say"),
  };
  for (const [id, run] of Object.entries(forms))
    element(id).addEventListener("submit", (event) => {
      event.preventDefault();
      run();
    });
  element("seek").addEventListener("input", drawSoon);
  const chosen = element<HTMLSelectElement>("saying-list");
  chosen.addEventListener("input", () => (element<HTMLInputElement>("text").value = chosen.value));
  for (const [command, words] of VISITOR) {
    const button = document.createElement("button");
    button.type = "button";
    button.textContent = words;
    button.addEventListener("click", () => askPerson(command));
    element("visitor").append(button);
  }
  const lists: Record<string, [string, string][]> = { "key-list": actions.map((one) => [one.key ?? "", one.about]), "recording-keys": KEYS };
  for (const [id, rows] of Object.entries(lists))
    for (const words of rows)
      for (const [place, name] of ["dt", "dd"].entries()) {
        const part = document.createElement(name);
        part.textContent = words[place]!;
        element(id).append(part);
      }
  bindKeys(actions, () => !element("live").hidden);
}

/** Show the view that the address names. */
function showView(): void {
  const view = viewOf(location.hash);
  for (const name of VIEWS) {
    element(name).hidden = name !== view.name;
    if (name === view.name) element(`to-${name}`).setAttribute("aria-current", "page");
    else element(`to-${name}`).removeAttribute("aria-current");
  }
  settle();
  wantPictures();
  if (view.name !== "recordings") recordings.close();
  if (view.name !== "networks") composer?.close();
  if (view.name === "recordings") void recordings.show(view.path);
  else if (view.name === "networks") void compose(view.path);
  else {
    document.title = "hri studio";
    drawSoon();
  }
}

let isChosen = false;

/** A robot that runs a network alone begins with that network. */
function showNetworkAlone(): void {
  const { about } = state.values;
  if (isChosen || about === undefined) return;
  isChosen = true;
  if (about.is_network && location.hash === "") location.replace(hashOf("networks", about.networks[0] ?? ""));
}

/** The composer is the largest part of the page: it comes when it is wanted. */
async function compose(path: string): Promise<void> {
  if (composer === null) {
    const { ComposerView } = await import("./composer/view");
    composer ??= new ComposerView(element("networks"), {
      ask: (command, given) => connection.ask(command, given).then(() => {}),
      want: (networks, thumbnails, reasons) => connection.wantValues(networks, thumbnails, reasons),
      hashOf: (other) => hashOf("networks", other),
    });
  }
  await composer.show(path || (state.values.about?.networks?.[0] ?? ""));
  composer.take(state.values);
}

function wantPictures(): void {
  connection.want(document.hidden || element("live").hidden ? [] : ["face", "camera"]);
}

/** Dialogs begin below the header, which has Stop. */
new ResizeObserver(([header]) => {
  const height = header!.target.getBoundingClientRect().height;
  document.documentElement.style.setProperty("--header", `${height}px`);
}).observe(document.querySelector("header")!);

bind();
connection.open();
showView();
window.addEventListener("hashchange", showView);
document.addEventListener("visibilitychange", wantPictures);
draw();
