/** Bytes of the largest file or packed text that the page reads. */
export const maxBytes = 20_000_000;

/** Why a file is not read; null if it is. */
export function tooLarge(file: File): string | null {
  return file.size <= maxBytes ? null : `${file.name} has ${file.size} bytes; at most ${maxBytes} are read`;
}
