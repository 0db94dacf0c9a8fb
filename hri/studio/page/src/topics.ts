// Written by `python -m hri.studio.type_export` from hri/studio/topics.py.

/** The robot and its app, which may be a network alone; `networks` are the files of the app. */
export interface About {
  api: number;
  app: string;
  about: string;
  is_simulated: boolean;
  has_base: boolean;
  is_network: boolean;
  networks: string[];
}

/** Ears and voice. */
export interface Speech {
  is_hearing: boolean;
  is_muted: boolean;
  is_held: boolean;
  is_speaking: boolean;
}

/** What can be said: some sentences of a rule of the grammar, and what it is about. */
export interface Saying {
  rule: string;
  about: string;
  examples: string[];
}

/** A cause of the feeling, with its share of it from 0 to 1. */
export interface FeelingCause {
  name: string;
  share: number;
  person: string;
}

/** What it feels: the mood's parts from -1 to 1, emotions and drives from 0 to 1. */
export interface Feeling {
  label: string;
  words: string;
  why: string;
  pleasure: number;
  arousal: number;
  dominance: number;
  emotions: Record<string, number>;
  drives: Record<string, number>;
  causes: FeelingCause[];
}

/** What began to be the strongest cause of the feeling, at a time in seconds. */
export interface Reason {
  t: number;
  label: string;
  why: string;
}

/** The mood of the last minutes: rows of time (seconds), pleasure, arousal, and dominance. */
export interface Moods {
  points: number[][];
  reasons: Reason[];
}

/** Someone in view: meters, radians to the left, seconds of the robot's clock; the box of the face, or of the body where that alone is seen, in pixels: left, top, width, height. */
export interface SeenPerson {
  id: string;
  name: string;
  distance: number | null;
  bearing: number | null;
  engagement: string;
  is_looking: boolean;
  is_attended: boolean;
  has_face: boolean;
  since: number | null;
  box: number[] | null;
}

/** The camera, and who is in view. */
export interface Eyes {
  is_watching: boolean;
  is_on: boolean;
  persons: SeenPerson[];
}

/** A range sensor: x, y, and direction on the robot; meters, None where nothing is in reach. */
export interface Range {
  id: string;
  at: number[];
  distance: number | null;
}

/** The base: x, y (meters), and heading (radians); m/s and rad/s; the battery from 0 to 1, null without one and while that is not known. */
export interface Base {
  pose: number[] | null;
  velocity: number[] | null;
  battery: number | null;
  has_battery: boolean;
  is_stopped: boolean;
  why: string;
  ranges: Range[];
}

/** Where and why the base stopped, at a time in seconds. */
export interface Stop {
  t: number;
  x: number;
  y: number;
  reason: string;
  words: string;
}

/** Where the base was, where it means to go (points in meters), and where it stopped. */
export interface Path {
  been: number[][];
  planned: number[][];
  stops: Stop[];
}

/** Someone in the simulated room. */
export interface SimulatedPerson {
  name: string;
  at: number[];
  is_present: boolean;
}

/** Something in the simulated room that can be seen. */
export interface Thing {
  name: string;
  at: number[];
}

/** Something round in the simulated room that was put there while the robot runs; meters. */
export interface PlacedObstacle {
  name: string;
  at: number[];
  radius: number;
}

/** The simulated room: walls (x1, y1, x2, y2), circles (x, y, radius), who and what is there. */
export interface World {
  walls: number[][];
  circles: number[][];
  people: SimulatedPerson[];
  things: Thing[];
  obstacles: PlacedObstacle[];
}

/** A device that is in use; `problem` is its problem and the remedy, or empty. */
export interface Device {
  id: string;
  says: string;
  stand_in: string;
  state: "ok" | "missing" | "trouble";
  problem: string;
}

/** A line of the log: seconds, how grave, the part of `hri` that wrote it, and the words. */
export interface LogLine {
  t: number;
  level: string;
  part: string;
  text: string;
}

/** Where a network pauses: an output, `behavior.output`, and what must hold for its value. */
export interface Breakpoint {
  port: string;
  condition: string;
}

/** A network that runs: its file, seconds between ticks, and whether the page started it. `hit` says at which breakpoint it paused; it is empty otherwise. */
export interface RunningNetwork {
  name: string;
  path: string;
  interval: number;
  is_paused: boolean;
  is_own: boolean;
  ticks: number;
  missed: number;
  breakpoint: Breakpoint | null;
  hit: string;
}

/** What the outputs of a network sent last, by `behavior.output` and `board.slot`. `cost` has, by behavior, microseconds of its last tick, of a tick on average, and of the longest, and how often it was the slowest of a missed tick; `resting` are those that failed. */
export interface PortValues {
  t: number;
  tick: number;
  values: Record<string, unknown>;
  cost: Record<string, number[]>;
  resting: string[];
}

/** An output or a slot on the way back to what decided, its value, and why it has that. */
export interface ReasonStep {
  port: string;
  value: unknown;
  words: string;
}

/** Something that happened, at a time in seconds; its own properties come beside. */
export interface RobotEvent {
  t: number;
  event: string;
  [key: string]: unknown;
}

/** What became of a stop that was sent over the WebSocket, by its number. */
export interface Answer {
  answer: number;
  error: string | null;
}

export interface Values {
  about?: About;
  speech?: Speech;
  sayings?: Saying[];
  feeling?: Feeling | null;
  moods?: Moods;
  people?: Eyes;
  base?: Base;
  path?: Path;
  world?: World | null;
  devices?: Device[];
  log?: LogLine[];
  networks?: RunningNetwork[];
  ports?: Record<string, PortValues>;
  thumbnails?: Record<string, string>;
  reasons?: Record<string, ReasonStep[]>;
}
