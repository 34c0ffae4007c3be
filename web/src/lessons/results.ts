import { compressed, decompressed } from "../address/compression.js";

/** An exercise that is solved: its name, the answer, and when, milliseconds since 1970. */
export interface Result {
  name: string;
  answer: string;
  time: number;
}

const key = "beeline-results";
const mark = "beeline1-";
const longestAnswer = 400; // characters
const most = 100; // results of a code
const minute = 60_000;

let kept: Result[] | null = null; // as long as the page is open, where the browser keeps nothing

function isResult(one: unknown): one is Result {
  const { name, answer, time } = (one ?? {}) as Partial<Result>;
  return typeof name === "string" && typeof answer === "string" && Number.isFinite(time);
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
  keep([...results().filter(({ name }) => name !== result.name), result]);
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

/** Four letters that a code of other content rarely has: a mistyped or cut code is noticed. It is no signature. */
function sumOf(text: string): string {
  let hash = 0x811c9dc5; // FNV-1a
  for (const letter of text) hash = Math.imul(hash ^ (letter.codePointAt(0) ?? 0), 0x01000193) >>> 0;
  return (hash % 36 ** 4).toString(36).padStart(4, "0");
}

/** Results as a code: letters, digits, - and _. Times are in minutes. */
export async function codeOf(all: Result[]): Promise<string> {
  const rows = all
    .slice(-most)
    .map(({ name, answer, time }) => [name, answer.slice(0, longestAnswer), Math.floor(time / minute)]);
  const packed = await compressed(new TextEncoder().encode(JSON.stringify(rows)));
  return `${mark}${packed}${sumOf(packed)}`;
}

/** The results of a code. Throws, with a sentence, where it is none. */
export async function resultsOf(code: string): Promise<Result[]> {
  const text = code.replace(/\s+/g, "");
  if (!text.startsWith(mark)) throw new Error(`a code begins with ${mark}`);
  const packed = text.slice(mark.length, -4);
  if (sumOf(packed) !== text.slice(-4)) throw new Error("the code is cut off or changed");
  try {
    const rows: unknown = JSON.parse(new TextDecoder().decode(await decompressed(packed)));
    const all = (rows as [string, string, number][]).map(([name, answer, at]) => ({ name, answer, time: at * minute }));
    if (!all.every(isResult)) throw new Error("other content");
    return all.slice(0, most);
  } catch {
    throw new Error("the code has other content than results");
  }
}
