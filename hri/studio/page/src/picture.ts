// A live picture on a canvas, decoded beside the page's own thread.

/** Shows JPEGs as they come. While one is being decoded, only the last of those that come waits: a slow
 * machine shows fewer pictures, never old ones. */
export class LivePicture {
  private readonly context: ImageBitmapRenderingContext;
  private isDecoding = false;
  private next: Blob | null = null;

  constructor(readonly canvas: HTMLCanvasElement) {
    this.context = canvas.getContext("bitmaprenderer")!;
  }

  async show(jpeg: Blob): Promise<void> {
    this.next = jpeg;
    if (this.isDecoding) return;
    this.isDecoding = true;
    while (this.next !== null) {
      const taken: Blob = this.next;
      this.next = null;
      const bitmap = await createImageBitmap(taken).catch(() => null);
      if (bitmap !== null) this.draw(bitmap);
    }
    this.isDecoding = false;
  }

  private draw(bitmap: ImageBitmap): void {
    if (this.canvas.width !== bitmap.width) this.canvas.width = bitmap.width;
    if (this.canvas.height !== bitmap.height) this.canvas.height = bitmap.height;
    this.context.transferFromImageBitmap(bitmap);
    this.canvas.dataset.shown = "yes";
  }
}
