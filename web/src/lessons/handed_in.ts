import { isWhole } from "./results.js";

/** A code among other text. */
export interface HandedIn {
  /** The words beside it, or "Code 2"; of a line without a code the line. */
  whose: string;
  /** Empty: the line has none. */
  code: string;
}

const unseen = /[\u00ad\u200b-\u200d\u2060\ufeff]/g; // what messengers and mail put between letters
const shortened = (text: string): string => (text.length > 40 ? `${text.slice(0, 40)} …` : text);
const named = (text: string): string => shortened(text.replace(/^[\s:,;"'>]+|[\s:,;"'<]+$/g, ""));

/** The codes in a text as messages have it: words before or after a code name whose it is, and a code may be wrapped over
 * several lines. */
export function codesIn(text: string): HandedIn[] {
  const found: HandedIn[] = [];
  const lines = text.replace(unseen, "").split("\n");
  for (const line of lines.filter((one) => one.trim() !== "")) {
    const last = found.at(-1);
    const [, more] = /^[\s>]*([\w-]+)[\s",.;]*$/.exec(line) ?? [];
    if (last && last.code !== "" && more !== undefined && !/^beeline\d+-/.test(more) && !isWhole(last.code)) {
      last.code += more;
      continue;
    }
    const codes = [...line.matchAll(/beeline\d+-[\w-]*/g)];
    if (codes.length === 0) found.push({ whose: shortened(line.trim()), code: "" });
    codes.forEach(({ 0: code, index }, i) => {
      const before = codes[i - 1];
      const from = before ? before.index + before[0].length : 0;
      const behind = codes.length === 1 ? named(line.slice(index + code.length)) : "";
      found.push({ whose: named(line.slice(from, index)) || behind || `Code ${found.length + 1}`, code });
    });
  }
  return found;
}
