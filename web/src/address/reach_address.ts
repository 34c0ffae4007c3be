import { measures, type Measure } from "../core/reach.js";
import { cellChoices, directionChoices, initialState, type PageState } from "../state/page_state.js";

/** The part of the state that the section Workspace owns. */
type ReachState = Pick<
  PageState,
  "reachCells" | "reachDirections" | "measure" | "level" | "sliceNormal" | "sliceAt" | "showSurface" | "showSlice"
>;

/** The words of an address and the part of the state that each sets. */
export const reachWords: [string, keyof ReachState][] = [
  ["cells", "reachCells"],
  ["directions", "reachDirections"],
  ["measure", "measure"],
  ["level", "level"],
  ["slice", "sliceNormal"],
  ["slice", "sliceAt"],
  ["surface", "showSurface"],
  ["tiles", "showSlice"],
];

/** Adds the words of what is not as it is initially; a slice as the command line has it, z=0.2. */
export function writeReach(words: URLSearchParams, state: ReachState): void {
  const { reachCells, reachDirections, measure, level, sliceNormal, sliceAt } = state;
  if (reachCells !== initialState.reachCells) words.set("cells", String(reachCells));
  if (reachDirections !== initialState.reachDirections) words.set("directions", String(reachDirections));
  if (measure !== initialState.measure) words.set("measure", measure);
  if (level !== initialState.level) words.set("level", String(level));
  const at = sliceAt === null ? "" : `=${sliceAt}`;
  if (sliceNormal !== initialState.sliceNormal || at !== "") words.set("slice", `${"xyz"[sliceNormal]}${at}`);
  if (!state.showSurface) words.set("surface", "0");
  if (!state.showSlice) words.set("tiles", "0");
}

/** Reads these words. What cannot be read has its initial value. */
export function reachOf(words: URLSearchParams): ReachState {
  const oneOf = (word: string, choices: number[], otherwise: number): number => {
    const value = Number(words.get(word) || NaN);
    return choices.includes(value) ? value : otherwise;
  };
  const measure = words.get("measure") as Measure;
  const level = Number(words.get("level") || NaN);
  const [, normal = "z", at] = /^([xyz])(?:=(.+))?$/.exec(words.get("slice") ?? "") ?? [];
  const coordinate = Number(at);
  return {
    reachCells: oneOf("cells", cellChoices, initialState.reachCells),
    reachDirections: oneOf("directions", directionChoices, initialState.reachDirections),
    measure: measures.includes(measure) ? measure : initialState.measure,
    level: level >= 0 && level <= 1 ? level : initialState.level,
    sliceNormal: "xyz".indexOf(normal),
    sliceAt: Number.isFinite(coordinate) ? coordinate : null,
    showSurface: words.get("surface") !== "0",
    showSlice: words.get("tiles") !== "0",
  };
}
