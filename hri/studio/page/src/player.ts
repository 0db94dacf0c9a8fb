// Plays a recording: the playhead, the sound, and the picture that belongs to it.

import { element } from "./dom";
import { Latest, Playhead, type About } from "./recording";

/** Seconds by which the sound may be elsewhere when it is started. */
const CLOSE = 0.05;

export class Player {
  private readonly head = new Playhead();
  private readonly audio = element<HTMLAudioElement>("rec-audio");
  private readonly face = element<HTMLImageElement>("rec-picture");
  private readonly pictures = new Latest<{ about: About; number: number }>((wanted) => this.fetch(wanted.about, wanted.number));
  private about: About | null = null;
  private address = "";
  /** Seconds of the sound that the browser has. */
  private loaded = 0;
  private frame = 0;
  private number = -1;

  /** `shown` is called with each time that the playhead comes to. */
  constructor(private readonly shown: (time: number) => void, private readonly wrong: (words: string) => void) {}

  get isPlaying(): boolean {
    return this.head.isPlaying;
  }

  get time(): number {
    return this.head.at(now());
  }

  /** Begin with a recording; null for none. */
  open(about: About | null): void {
    this.play(false);
    this.take(about);
    this.number = -1;
    this.face.removeAttribute("src");
    this.loaded = 0;
    this.audio.removeAttribute("src");
    this.audio.load();
    this.head.go(about?.start ?? 0, now());
    this.show();
  }

  /** What is known of the recording by now: it may have grown. */
  take(about: About | null): void {
    this.about = about;
  }

  play(isPlaying: boolean): void {
    if (isPlaying === this.isPlaying || this.about === null) return;
    if (isPlaying && this.time >= this.about.end - CLOSE) this.head.go(this.about.start, now());
    this.head.play(isPlaying, now());
    this.playSound();
    if (isPlaying) this.frame = requestAnimationFrame(() => this.step());
    else cancelAnimationFrame(this.frame);
    this.show();
  }

  setSpeed(speed: number): void {
    this.head.setSpeed(speed, now());
    this.audio.playbackRate = speed;
  }

  setMuted(isMuted: boolean): void {
    this.audio.muted = isMuted;
  }

  go(time: number): void {
    if (this.about === null) return;
    this.head.go(Math.min(this.about.end, Math.max(this.about.start, time)), now());
    this.audio.pause();
    this.playSound();
    this.show();
  }

  private step(): void {
    if (!this.isPlaying || this.about === null) return;
    const { audio } = this;
    // The sound cannot wait, the picture can: it says where the playhead is.
    if (!audio.paused && !audio.seeking && audio.readyState >= 3) this.head.go(audio.currentTime + this.about.sound!.start, now());
    else this.playSound();
    if (this.time >= this.about.end) {
      this.head.go(this.about.end, now());
      this.play(false);
    }
    this.show();
    if (this.isPlaying) this.frame = requestAnimationFrame(() => this.step());
  }

  private playSound(): void {
    const { audio } = this;
    const sound = this.about?.sound;
    const place = sound ? this.time - sound.start : -1;
    if (!this.isPlaying || !sound || place < 0 || place >= sound.length - CLOSE) {
      audio.pause();
      return;
    }
    if (!audio.paused) return;
    if (place >= this.loaded - CLOSE) {
      // Only what is there now: the browser would stumble over a file that grows.
      audio.src = `${addressOf("sound", this.about!)}&bytes=${sound.bytes}`;
      this.loaded = sound.length;
    }
    audio.playbackRate = this.head.speed;
    if (Math.abs(audio.currentTime - place) > CLOSE) audio.currentTime = place;
    audio.play().catch(() => undefined); // the page's clock goes on without it
  }

  private show(): void {
    const { about } = this;
    this.shown(this.time);
    if (!about?.face) return;
    const last = Math.round(about.face.length * about.face.rate) - 1;
    const number = Math.min(last, Math.max(0, Math.floor((this.time - about.face.start) * about.face.rate + 1e-3)));
    if (number === this.number) return;
    this.number = number;
    this.pictures.want({ about, number });
  }

  private async fetch(about: About, number: number): Promise<void> {
    const { start, rate } = about.face!;
    const response = await fetch(`${addressOf("face", about)}&t=${(start + number / rate).toFixed(4)}`);
    if (about.folder !== this.about?.folder) return;
    if (!response.ok) {
      this.wrong(((await response.json()) as { error: string }).error);
      return;
    }
    const address = URL.createObjectURL(await response.blob());
    this.face.src = address;
    await this.face.decode().catch(() => undefined);
    if (this.address) URL.revokeObjectURL(this.address);
    this.address = address;
  }
}

export function addressOf(what: string, about: { folder: string }): string {
  return `/api/v1/recordings/${what}?folder=${encodeURIComponent(about.folder)}`;
}

function now(): number {
  return performance.now() / 1000;
}
