// Something that lasts while a button is held: it is asked for again and again, so that it ends by
// itself where the page vanishes.

const AGAIN_MS = 500;

export class Hold {
  private timer = 0;

  constructor(
    private readonly button: HTMLButtonElement,
    private readonly tell: (on: boolean) => void,
  ) {
    button.addEventListener("pointerdown", (event) => {
      if (event.button === 0) this.begin();
    });
    for (const name of ["pointerup", "pointercancel", "pointerleave", "blur"]) button.addEventListener(name, () => this.end());
    button.addEventListener("contextmenu", (event) => event.preventDefault());
    button.addEventListener("keydown", (event) => {
      if (event.key !== " " && event.key !== "Enter") return;
      event.preventDefault();
      if (!event.repeat) this.begin();
    });
    button.addEventListener("keyup", (event) => {
      if (event.key === " " || event.key === "Enter") this.end();
    });
  }

  begin(): void {
    if (this.timer) return;
    this.button.setAttribute("aria-pressed", "true");
    this.tell(true);
    this.timer = window.setInterval(() => this.tell(true), AGAIN_MS);
  }

  end(): void {
    if (!this.timer) return;
    clearInterval(this.timer);
    this.timer = 0;
    this.button.setAttribute("aria-pressed", "false");
    this.tell(false);
  }
}
