// The link to the server: messages come over a WebSocket, which is opened again when it ends;
// commands go as single requests, so that a stop needs no open link.

export type Picture = "face" | "camera";
const PICTURES: Record<number, Picture> = { 2: "face", 3: "camera" };
const HEAD = 9;

export interface Listener {
  message(message: unknown): void;
  picture(which: Picture, jpeg: Blob, time: number): void;
  linked(isLinked: boolean, isKnown: boolean): void;
}

export class Connection {
  private socket: WebSocket | null = null;
  private wanted = { pictures: [] as Picture[], networks: [] as string[], thumbnails: [] as string[] };
  private wait = 250;

  constructor(private readonly listener: Listener) {}

  open(): void {
    const socket = new WebSocket(`${location.protocol === "https:" ? "wss" : "ws"}://${location.host}/api/v1/live`);
    socket.binaryType = "arraybuffer";
    let wasOpen = false;
    socket.onopen = () => {
      wasOpen = true;
      this.wait = 250;
      this.listener.linked(true, true);
      this.tellWanted();
    };
    socket.onmessage = (event) => this.take(event.data as string | ArrayBuffer);
    socket.onclose = () => {
      this.socket = null;
      void this.explain(wasOpen);
      setTimeout(() => this.open(), this.wait);
      this.wait = Math.min(1000, this.wait * 2);
    };
    this.socket = socket;
  }

  want(pictures: Picture[]): void {
    this.wanted.pictures = pictures;
    this.tellWanted();
  }

  /** The networks whose values are wanted, by name, and the outputs (`network/behavior.output`) of pictures. */
  wantValues(networks: string[], thumbnails: string[]): void {
    this.wanted = { ...this.wanted, networks, thumbnails };
    this.tellWanted();
  }

  /** Ask the robot; what it refuses is an Error. */
  async ask(command: string, given: Record<string, unknown> = {}): Promise<unknown> {
    const response = await fetch(`/api/v1/${command}`, {
      method: "POST",
      headers: { "content-type": "application/json" },
      body: JSON.stringify(given),
    });
    const answer = (await response.json()) as { error?: string; result?: unknown };
    if (answer.error) throw new Error(answer.error);
    return answer.result;
  }

  private tellWanted(): void {
    if (this.socket?.readyState === WebSocket.OPEN) this.socket.send(JSON.stringify(this.wanted));
  }

  private take(data: string | ArrayBuffer): void {
    if (typeof data === "string") {
      this.listener.message(JSON.parse(data));
      return;
    }
    const head = new DataView(data);
    const which = PICTURES[head.getUint8(0)];
    if (which === undefined) return;
    this.listener.picture(which, new Blob([data.slice(HEAD)], { type: "image/jpeg" }), head.getFloat64(1));
  }

  private async explain(wasOpen: boolean): Promise<void> {
    let isKnown = true;
    if (!wasOpen) {
      const response = await fetch("/api/v1/state").catch(() => null);
      isKnown = response?.status !== 401;
    }
    this.listener.linked(false, isKnown);
  }
}
