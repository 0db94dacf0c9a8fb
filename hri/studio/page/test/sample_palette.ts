// A few of the behaviors that there are, as the server describes them.

import type { BehaviorType, Palette, Port } from "../src/composer/wiring";

function port(text: string): Port {
  const [name = "", datatype = "any", semantic = "Evolution.Generic"] = text.replace("?", "").split(":");
  return { name, datatype, semantic, description: "", is_optional: text.endsWith("?") };
}

function kind(type: string, inputs: string[], outputs: string[], parameters: Record<string, string> = {}): BehaviorType {
  return {
    type,
    category: "operators",
    display_name: type,
    about: "",
    is_sensor: inputs.length === 0 && type !== "Hri.Constant",
    library: "",
    parameters: Object.entries(parameters).map(([name, text]) => ({ name, type: "number", default: text, description: "", minimum: null, maximum: null, choices: [], unit: "", interface: null })),
    inputs: inputs.map(port),
    outputs: outputs.map(port),
  };
}

export const PALETTE: Palette = {
  mark: "1",
  behaviors: [
    kind("Hri.Constant", [], ["value:any"], { parsed_value: "0" }),
    kind("Hri.Scale", ["input:double"], ["output:double"], { factor: "1" }),
    kind("Hri.Addition", ["input:double"], ["sum:double"]),
    kind("Hri.Division", ["dividend:double", "divisor:double"], ["quotient:double"]),
    kind("Hri.Minimum", ["input:double"], ["minimum:double"]),
    kind("Hri.Maximum", ["input:double"], ["maximum:double"]),
    kind("Hri.And", ["input:boolean"], ["result:boolean"]),
    kind("Hri.Not", ["input:boolean"], ["result:boolean"]),
    kind("Hri.Greater", ["first:double", "second:double"], ["is_greater:boolean"]),
    kind("Hri.Select", ["choice:boolean", "when_true:any", "when_false:any"], ["selected:any"]),
    kind("Hri.Inhibit", ["input:any", "inhibitor:any", "replacement:any"], ["output:any"], { hold_s: "0.5" }),
    kind("Hri.PriorityArbiter", ["input:any"], ["winner:any"]),
    kind("Hri.InputCollector", ["input:any"], []),
    kind("Hri.RangeSensor", [], ["distance:double:Hri.Distance"]),
    kind("Hri.Wheel", ["speed:double:Hri.Speed"], []),
    kind("Hri.Voice", ["text:string", "prosody:prosody?"], ["speech:speech"]),
  ],
  aliases: { "Examples.Adder": "Hri.Addition", "Evolution.Addition": "Hri.Addition" },
  datatypes: {},
  slots: [{ name: "drive.command", datatype: "twist", semantic: "Evolution.Generic", about: "what tasks ask the base for" }],
  devices: [],
  broken: [],
};
