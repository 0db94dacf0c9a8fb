// The link to the server: messages come over a WebSocket, which is opened again when it ends;
// commands go as single requests. A stop goes by both ways: it needs no open link, and no further
// connection.

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
  private wanted = { pictures: [] as Picture[], networks: [] as string[], thumbnails: [] as string[], reasons: [] as string[] };
  private wait = 250;
  private stops = 0;
  /** What to tell those who stopped the robot over the link, by number. */
  private readonly stopped = new Map<number, (error: Error | null) => void>();

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
      for (const tell of [...this.stopped.values()]) tell(new TypeError("the link has ended"));
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

  /** The networks whose values are wanted, by name, the outputs (`network/behavior.output`) of pictures, and the ports of reasons. */
  wantValues(networks: string[], thumbnails: string[], reasons: string[]): void {
    this.wanted = { ...this.wanted, networks, thumbnails, reasons };
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

  /** Stop the robot by every way at once; the first that succeeds counts. The press has a name, so that
   * the slower way does not stop it again when it was released meanwhile. */
  async stop(): Promise<void> {
    const press = `${Date.now()} ${Math.random()}`;
    const ways = [this.ask("stop", { press }), this.stopOverLink(press)];
    await Promise.any(ways).catch((failed: AggregateError) => Promise.reject(failed.errors[0]));
  }

  private stopOverLink(press: string): Promise<void> {
    return new Promise((done, fail) => {
      if (this.socket?.readyState !== WebSocket.OPEN) return fail(new TypeError("no link"));
      const number = ++this.stops;
      this.stopped.set(number, (error) => {
        this.stopped.delete(number);
        if (error === null) done();
        else fail(error);
      });
      this.socket.send(JSON.stringify({ command: "stop", number, press }));
    });
  }

  private tellWanted(): void {
    if (this.socket?.readyState === WebSocket.OPEN) this.socket.send(JSON.stringify(this.wanted));
  }

  private take(data: string | ArrayBuffer): void {
    if (typeof data === "string") {
      const message = JSON.parse(data) as { answer?: number; error?: string | null };
      if (message.answer === undefined) this.listener.message(message);
      else this.stopped.get(message.answer)?.(message.error ? new Error(message.error) : null);
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
