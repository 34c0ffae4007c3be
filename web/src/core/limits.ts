/** Bytes of the largest file or packed text that the page reads. */
export const maxBytes = 20_000_000;
