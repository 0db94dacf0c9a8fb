// The composer as a view of the studio; loaded when it is opened first.

import { createRoot, type Root } from "react-dom/client";
import type { Values } from "../topics";
import { viewOf } from "../views";
import { Composer } from "./app";
import { ComposerDocument } from "./document";
import { LiveValues } from "./live_values";
import type { Ask } from "./run_bar";

export interface Host {
  ask(command: string, given: Record<string, unknown>): Promise<void>;
  want(networks: string[], thumbnails: string[], reasons: string[]): void;
  /** The address of the view of a network, for the page's history. */
  hashOf(path: string): string;
}

export class ComposerView {
  private readonly doc = new ComposerDocument();
  private readonly live = new LiveValues();
  private root: Root | null = null;
  private readonly ask: Ask;

  constructor(
    private readonly place: HTMLElement,
    private readonly host: Host,
  ) {
    this.ask = async (command, given) => {
      const isDone = await this.doc.attempt(() => host.ask(command, given));
      if (isDone) this.doc.notice.set(""); // why something was refused before
      return isDone;
    };
    this.doc.autosave.follow(window);
    const sheet = document.createElement("link");
    sheet.rel = "stylesheet";
    sheet.href = "/composer.css";
    document.head.append(sheet);
  }

  /** Show a network, or what was open last. */
  async show(path: string): Promise<void> {
    document.title = "hri studio: networks";
    if (this.root === null) {
      this.root = createRoot(this.place);
      const open = (other: string) => {
        location.hash = this.host.hashOf(other);
      };
      const want: Host["want"] = (...wanted) => this.host.want(...wanted);
      this.root.render(<Composer doc={this.doc} live={this.live} ask={this.ask} open={open} want={want} />);
    }
    this.doc.begin();
    // While this code is loaded, two calls may come in the wrong order: the address knows the last.
    const wanted = addressed() || path;
    if (!wanted || (await this.doc.open(wanted))) return;
    const shown = this.doc.path.value;
    if (addressed() === wanted && shown) history.replaceState(null, "", this.host.hashOf(shown));
  }

  close(): void {
    this.doc.end();
    this.host.want([], [], []);
  }

  /** The newest values of the robot's topics. */
  take({ networks, ports, thumbnails, reasons }: Values): void {
    this.live.take(networks ?? [], ports, thumbnails, reasons);
  }
}

/** The network that the address names; empty for none. */
function addressed(): string {
  const { name, path } = viewOf(location.hash);
  return name === "networks" ? path : "";
}
