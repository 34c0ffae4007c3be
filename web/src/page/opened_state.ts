import { partOf, sceneFault, stateOf } from "../address/address.js";
import { lessonOf } from "../lessons/lessons.js";
import type { PageState } from "../state/page_state.js";

/** The state of an address; a lesson begins with its figure where the address has no arm. An unknown lesson is replaced by
 * the first one. `longest`: the characters that are read. */
export async function stateAt(hash: string, longest?: number): Promise<PageState> {
  const state = await stateOf(hash, longest);
  if (state.lesson === "" || state.section !== "lessons") return state;
  const { id, scene } = lessonOf(state.lesson);
  const own = { ...state, ...(await partOf(scene)), ...(await partOf(hash, longest)) };
  return id === state.lesson ? own : { ...own, lesson: id, only: state.only === "" ? "" : "lesson" };
}

/** Why a part of an address whose state this is cannot be shown; empty where all is. */
export function faultOf(hash: string, state: PageState): string {
  const asked = new URLSearchParams(hash.replace(/^#/, "")).get("lesson") ?? "";
  if (state.section !== "lessons" || asked === "" || asked === state.lesson) return sceneFault(hash, state);
  return `There is no lesson ${asked.slice(0, 40)}: this is lesson ${lessonOf(state.lesson).title}.`;
}
