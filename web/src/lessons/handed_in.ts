import { isWhole, piecesToWhole } from "./results.js";
import { trimmed } from "./trimming.js";

/** A code among other text. */
export interface HandedIn {
  /** The words beside it or in the line above it, or "Code 2"; of a line without a code the line. */
  whose: string;
  /** Empty: the line has none, and names no code. */
  code: string;
}

/** Characters that are read at once: the codes of some hundred students. */
export const longestText = 500_000;

const unseen = /[\u00ad\u200b-\u200d\u2060\ufeff]/g; // what messengers and mail put between letters
const longestName = 40;
const shortened = (text: string): string => (text.length > longestName ? `${text.slice(0, longestName)} …` : text);
const named = (text: string): string => shortened(trimmed(text, ":,;\"'>", ":,;\"'<"));

/** Whether a line can be the name of a code below it: a long word is the rest of another code. */
const isName = (line: string): boolean => /\s/.test(line.trim()) || line.trim().length <= longestName;

/** The pieces in the lines that follow a cut code: up to the next code, and up to a line of several words. */
function piecesIn(lines: string[], from: number): string[] {
  const pieces: string[] = [];
  for (let i = from; i < lines.length; ++i) {
    const [, piece] = /^[\s>]*([\w-]+)[\s",.;]*$/.exec(lines[i] ?? "") ?? [];
    if (piece === undefined || /^beeline\d+-/.test(piece)) break;
    pieces.push(piece);
  }
  return pieces;
}

/** The codes in a text as messages have it: words before or after a code, or in the line above, name whose it is; and a code
 * may be wrapped over several lines, which together are whole. */
export function codesIn(text: string): HandedIn[] {
  const found: HandedIn[] = [];
  const lines = text
    .replace(unseen, "")
    .split("\n")
    .filter((one) => one.trim() !== "");
  let above = ""; // a line without a code
  const leave = (): void => {
    if (above !== "") found.push({ whose: shortened(above.trim()), code: "" });
    above = "";
  };
  for (let next = 0; next < lines.length;) {
    const line = lines[next++] ?? "";
    const codes = [...line.matchAll(/beeline\d+-[\w-]*/g)];
    if (codes.length === 0) {
      leave();
      above = line;
    }
    for (const [i, { 0: code, index }] of codes.entries()) {
      const before = codes[i - 1];
      const from = before ? before.index + before[0].length : 0;
      const behind = codes.length === 1 ? named(line.slice(index + code.length)) : "";
      const beside = named(line.slice(from, index)) || behind;
      const whose = beside || (isName(above) ? named(above) : "");
      if (beside === "" && isName(above)) above = "";
      leave();
      found.push({ whose: whose || `Code ${found.length + 1}`, code });
    }
    const last = found.at(-1);
    if (codes.length === 0 || !last || isWhole(last.code)) continue;
    const pieces = piecesIn(lines, next);
    const count = piecesToWhole(last.code, pieces);
    last.code += pieces.slice(0, count).join("");
    next += count;
  }
  leave();
  return found;
}
