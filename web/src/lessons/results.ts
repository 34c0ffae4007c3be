import { compressed, decompressed } from "../address/compression.js";

/** An exercise that is solved: its name, the answer, and when, milliseconds since 1970. */
export interface Result {
  name: string;
  answer: string;
  time: number;
}

const key = "beeline-results";
const mark = "beeline1-";
const longestAnswer = 4100; // characters: four formulas
const longestName = 40;
const longestCode = 20_000;
const longestContent = 500_000; // bytes, unpacked
const most = 100; // results of a code
const minute = 60_000;
const lastMinute = 1e8; // in the year 2160

let kept: Result[] | null = null; // as long as the page is open, where the browser keeps nothing

function isResult(one: unknown): one is Result {
  const { name, answer, time } = (one ?? {}) as Partial<Result>;
  if (typeof name !== "string" || typeof answer !== "string" || typeof time !== "number") return false;
  const isTime = Number.isFinite(time) && time >= 0 && time < (lastMinute + 1) * minute;
  return name.length <= longestName && answer.length <= longestAnswer && isTime;
}

/** What was solved in this browser. */
export function results(): Result[] {
  try {
    const list: unknown = JSON.parse(localStorage.getItem(key) ?? "[]");
    return Array.isArray(list) && kept === null ? list.filter(isResult) : (kept ?? []);
  } catch {
    return kept ?? [];
  }
}

/** Keeps a result; of an exercise that is solved again the later one. */
export function keepResult(result: Result): void {
  const answer = result.answer.replace(/\s+/g, " ").trim();
  keep([...results().filter(({ name }) => name !== result.name), { ...result, answer }]);
}

export function forgetResults(): void {
  keep([]);
}

function keep(all: Result[]): void {
  try {
    localStorage.setItem(key, JSON.stringify(all));
  } catch {
    kept = all; // a frame of another site, or a page from a disk
  }
}

const sumLetters = 4;
const emptyHash = 0x811c9dc5; // FNV-1a
const hashed = (hash: number, letter: string): number => Math.imul(hash ^ letter.charCodeAt(0), 0x01000193) >>> 0;
const sumOfHash = (hash: number): string => (hash % 36 ** sumLetters).toString(36).padStart(sumLetters, "0");

/** Four letters that a code of other content rarely has: a mistyped or cut code is noticed. It is no signature. */
function sumOf(text: string): string {
  let hash = emptyHash;
  for (const letter of text) hash = hashed(hash, letter);
  return sumOfHash(hash);
}

/** Content as a code: letters, digits, - and _. */
export async function codeOfContent(content: unknown): Promise<string> {
  const packed = await compressed(new TextEncoder().encode(JSON.stringify(content)));
  return `${mark}${packed}${sumOf(packed)}`;
}

/** Results as a code. Times are in minutes. */
export function codeOf(all: Result[]): Promise<string> {
  const some = all.slice(-most);
  return codeOfContent(
    some.map(({ name, answer, time }) => [name, answer.slice(0, longestAnswer), Math.floor(time / minute)]),
  );
}

/** How many of the pieces that follow a cut code make it whole; 0: they do not. */
export function piecesToWhole(code: string, pieces: string[]): number {
  const counts = new Map<number, number>(); // of pieces, by where the last one ends
  let end = code.length;
  for (const [i, piece] of pieces.entries()) counts.set((end += piece.length), i + 1);
  const text = [code, ...pieces].join("").slice(0, longestCode);
  let hash = emptyHash;
  for (let at = mark.length; at < text.length && code.startsWith(mark); ++at) {
    const count = counts.get(at + sumLetters);
    if (count !== undefined && sumOfHash(hash) === text.slice(at, at + sumLetters)) return count;
    hash = hashed(hash, text[at] ?? "");
  }
  return 0;
}

/** Whether a code is neither cut off nor mistyped. */
export function isWhole(code: string): boolean {
  return code.startsWith(mark) && sumOf(code.slice(mark.length, -sumLetters)) === code.slice(-sumLetters);
}

/** The result of a row of a code. Throws where it is none. */
function resultOf(row: unknown): Result {
  const [name, answer, at] = row as unknown[];
  const one = { name, answer, time: Number.isInteger(at) ? (at as number) * minute : NaN };
  if (!isResult(one)) throw new Error("other content");
  return one;
}

/** The results of a code. Throws, with a sentence, where it is none. */
export async function resultsOf(code: string): Promise<Result[]> {
  const text = code.replace(/\s+/g, "");
  if (!text.startsWith(mark) && /^beeline\d+-/.test(text)) throw new Error("the code is of another version of Beeline");
  if (!text.startsWith(mark)) throw new Error(`a code begins with ${mark}`);
  if (text.length > longestCode) throw new Error("the code is longer than any that the page makes");
  if (!isWhole(text)) throw new Error("the code is cut off or changed");
  try {
    const content = await decompressed(text.slice(mark.length, -sumLetters), longestContent);
    const rows = JSON.parse(new TextDecoder().decode(content)) as unknown[];
    if (rows.length > most) throw new Error("other content");
    return rows.map(resultOf);
  } catch {
    throw new Error("the code has other content than results");
  }
}
