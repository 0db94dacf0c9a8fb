// A wire's color is that of its datatype, the same as in the pictures of `hri network draw`.

const COLORS = 7;

/** A CSS variable, so that the dark page has colors for its ground. */
export function wireColor(datatype: string): string {
  return `var(--wire-${crc32(new TextEncoder().encode(datatype)) % COLORS})`;
}

/** The checksum of zlib, bit by bit: names are short. */
export function crc32(bytes: Uint8Array): number {
  let rest = 0xffffffff;
  for (const byte of bytes) {
    rest ^= byte;
    for (let bit = 0; bit < 8; bit++) rest = rest & 1 ? (rest >>> 1) ^ 0xedb88320 : rest >>> 1;
  }
  return (rest ^ 0xffffffff) >>> 0;
}
