import {
  formerSections,
  gainRanges,
  initialState,
  sections,
  type ArmSource,
  type PageState,
  type Section,
} from "../state/page_state.js";
import { frames, type Frame } from "../core/types.js";
import { noObstacles, sceneOf } from "../core/scene.js";
import { compressed, decompressed } from "./compression.js";
import { reachOf, reachWords, writeReach } from "./reach_address.js";

const gains = ["gain", "ki", "kd"] as const;
/** Characters of an address that are read; a longer one is not written either. A saved page has no such bound. */
export const longestAddress = 200_000;
const maxJoints = 1000;

function numbers(text: string | null): number[] | null {
  if (text === null || text === "") return null;
  const values = text.split(",", maxJoints + 1).map((item) => (item.trim() === "" ? NaN : Number(item)));
  return values.length <= maxJoints && values.every(Number.isFinite) ? values : null;
}

/** Poses of seven numbers with semicolons between; none where one is not. */
function poses(text: string | null): number[][] {
  const rows = text === null || text === "" ? [] : text.split(";").map(numbers);
  return rows.every((row) => row?.length === 7) ? (rows as number[][]) : [];
}

/** The shortest text that reads back as the same number. */
function list(values: number[]): string {
  return values.map(String).join(",");
}

async function sourceOf(words: URLSearchParams): Promise<ArmSource> {
  const json = words.get("json");
  if (json !== null) return { json: new TextDecoder().decode(await decompressed(json)) };
  return { text: words.get("arm") ?? (initialState.arm as { text: string }).text };
}

/** The text of a scene; none where it cannot be read. */
async function sceneIn(words: URLSearchParams): Promise<string> {
  const scene = words.get("scene");
  if (scene === null) return initialState.scene;
  const text = new TextDecoder().decode(await decompressed(scene).catch(() => new Uint8Array()));
  return sceneOf(text) === noObstacles ? "" : text;
}

/** What is wrong with the obstacles of an address whose state this is; empty where nothing is. */
export function sceneFault(hash: string, { scene }: PageState): string {
  const isGiven = scene === "" && new URLSearchParams(hash.replace(/^#/, "")).has("scene");
  return isGiven ? "The obstacles of this address cannot be read: it is cut off or changed. There are none now." : "";
}

/** The part of an address behind #, which holds the state. Numbers are exact. */
export async function addressOf(state: PageState): Promise<string> {
  const words = new URLSearchParams();
  if ("json" in state.arm) words.set("json", await compressed(new TextEncoder().encode(state.arm.json)));
  else words.set("arm", state.arm.text);
  if (state.q) words.set("q", list(state.q));
  if (state.section !== initialState.section) words.set("section", state.section);
  if (!state.degrees) words.set("unit", "rad");
  if (state.frame !== initialState.frame) words.set("frame", state.frame);
  if (state.showFrames) words.set("frames", "1");
  if (!state.showAngles) words.set("angles", "0");
  if (state.showSolutions) words.set("solutions", "1");
  if (state.showColumns) words.set("columns", "1");
  if (state.showEllipsoid) words.set("ellipsoid", "1");
  if (state.goal) words.set("goal", list(state.goal));
  for (const gain of gains) if (state[gain] !== initialState[gain]) words.set(gain, String(state[gain]));
  if (state.waypoints.length > 0) words.set("waypoints", state.waypoints.map(list).join(";"));
  if (state.scene !== "") words.set("scene", await compressed(new TextEncoder().encode(state.scene)));
  if (state.clearance !== initialState.clearance) words.set("clearance", String(state.clearance));
  if (state.passes) words.set("passes", "1");
  if (!state.showShapes) words.set("shapes", "0");
  writeReach(words, state);
  if (state.lesson !== "") words.set("lesson", state.lesson);
  if (state.only !== "") words.set("only", state.only);
  if (!state.help) words.set("help", "0");
  return words.toString().replaceAll("%2C", ",").replaceAll("%3B", ";").replaceAll("%3D", "=");
}

/** The state of an address. What cannot be read has its initial value. `longest`: the characters that are read. */
export async function stateOf(hash: string, longest = longestAddress): Promise<PageState> {
  const words = new URLSearchParams(hash.replace(/^#/, "").slice(0, longest));
  const given = words.get("section") ?? "";
  const section = (Object.hasOwn(formerSections, given) ? formerSections[given] : given) as Section;
  const frame = words.get("frame") as Frame;
  const gainOf = (name: (typeof gains)[number]): number => {
    const value = Number(words.get(name) || NaN);
    const { min, max } = gainRanges[name];
    return Number.isFinite(value) ? Math.min(max, Math.max(min, value)) : initialState[name];
  };
  return {
    arm: await sourceOf(words).catch(() => ({ json: "" })), // which is refused with a reason
    q: numbers(words.get("q")),
    degrees: words.get("unit") !== "rad",
    section: sections.includes(section) ? section : initialState.section,
    frame: frames.includes(frame) ? frame : initialState.frame,
    showFrames: words.get("frames") === "1",
    showAngles: words.get("angles") !== "0",
    showSolutions: words.get("solutions") === "1",
    showColumns: words.get("columns") === "1",
    showEllipsoid: words.get("ellipsoid") === "1",
    goal: numbers(words.get("goal")),
    gain: gainOf("gain"),
    ki: gainOf("ki"),
    kd: gainOf("kd"),
    waypoints: poses(words.get("waypoints")),
    scene: await sceneIn(words),
    clearance: Math.max(0, Number(words.get("clearance")) || initialState.clearance),
    passes: words.get("passes") === "1",
    showShapes: words.get("shapes") !== "0",
    ...reachOf(words),
    lesson: words.get("lesson") ?? "",
    only: words.get("only") ?? "",
    help: words.get("help") !== "0",
  };
}

/** The words of an address and the part of the state that each sets. */
const named: [string, keyof PageState][] = [
  ["arm", "arm"],
  ["json", "arm"],
  ["q", "q"],
  ["section", "section"],
  ["unit", "degrees"],
  ["frame", "frame"],
  ["frames", "showFrames"],
  ["angles", "showAngles"],
  ["columns", "showColumns"],
  ["solutions", "showSolutions"],
  ["ellipsoid", "showEllipsoid"],
  ["goal", "goal"],
  ["gain", "gain"],
  ["ki", "ki"],
  ["kd", "kd"],
  ["waypoints", "waypoints"],
  ["scene", "scene"],
  ["clearance", "clearance"],
  ["passes", "passes"],
  ["shapes", "showShapes"],
  ...reachWords,
  ["lesson", "lesson"],
  ["only", "only"],
  ["help", "help"],
];

/** What an address holds of the state, and nothing else. */
export async function partOf(hash: string, longest = longestAddress): Promise<Partial<PageState>> {
  const words = new URLSearchParams(hash.replace(/^#/, "").slice(0, longest));
  const state = await stateOf(hash, longest);
  return Object.fromEntries(named.filter(([word]) => words.has(word)).map(([, key]) => [key, state[key]]));
}
