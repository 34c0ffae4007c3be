import { maxBytes } from "../core/limits.js";

async function through(
  stream: ReadableWritablePair<Uint8Array, BufferSource>,
  bytes: Uint8Array,
  most = maxBytes,
): Promise<Uint8Array> {
  const reader = new Blob([bytes as BufferSource]).stream().pipeThrough(stream).getReader();
  const parts: Uint8Array[] = [];
  let size = 0;
  for (let part = await reader.read(); !part.done; part = await reader.read()) {
    size += part.value.length;
    if (size > most) {
      void reader.cancel();
      throw new Error(`the packed text has more than ${most} bytes`);
    }
    parts.push(part.value);
  }
  const all = new Uint8Array(size);
  let at = 0;
  for (const part of parts) {
    all.set(part, at);
    at += part.length;
  }
  return all;
}

/** Bytes as letters, digits, - and _, deflated: for addresses and saved pages. */
export async function compressed(content: Uint8Array): Promise<string> {
  const bytes = await through(new CompressionStream("deflate-raw"), content);
  const pieces: string[] = [];
  const piece = 8192; // arguments of a function
  for (let i = 0; i < bytes.length; i += piece) pieces.push(String.fromCharCode(...bytes.subarray(i, i + piece)));
  return btoa(pieces.join("")).replaceAll("+", "-").replaceAll("/", "_").replaceAll("=", "");
}

/** The bytes of compressed(), at most `most`. Throws for anything else. */
export async function decompressed(text: string, most = maxBytes): Promise<Uint8Array> {
  const binary = atob(text.trim().replaceAll("-", "+").replaceAll("_", "/"));
  const bytes = Uint8Array.from(binary, (letter) => letter.charCodeAt(0));
  return through(new DecompressionStream("deflate-raw"), bytes, most);
}
