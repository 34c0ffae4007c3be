import type { Measure } from "../core/reach.js";

/** The parts of the page, each with a panel of its own. */
export const sections = ["pose", "control", "line", "obstacles", "workspace", "lessons"] as const;
export type Section = (typeof sections)[number];
/** What sections were called in older links. */
export const formerSections: Record<string, Section> = { hold: "pose", motion: "line", reach: "workspace" };

/** Where the arm comes from: an argument ARM of the command line (a built-in name or a joint string), or the JSON that
 * `beeline show --out` writes. */
export type ArmSource = { text: string } | { json: string };

/** What a link to the page holds: the address has all of it. The camera, meshes, trajectories and waypoints of a file are
 * not part of it. */
export interface PageState {
  arm: ArmSource;
  /** Radians and metres; null: one that shows the arm well. */
  q: number[] | null;
  degrees: boolean;
  section: Section;
  /** The frame of the Jacobian in the panel. */
  frame: "base" | "tool" | "space";
  showFrames: boolean;
  /** The angles of the joints in the picture of a planar arm. */
  showAngles: boolean;
  showSolutions: boolean;
  /** The columns of the Jacobian as arrows at the tool. */
  showColumns: boolean;
  showEllipsoid: boolean;
  /** The goal of the section Control, as a configuration; null: each joint a third of the way to its farther limit. */
  goal: number[] | null;
  /** Gains of the controllers, per step; ki and kd of joint-space control only. */
  gain: number;
  ki: number;
  kd: number;
  /** Poses of a line: x y z qw qx qy qz. */
  waypoints: number[][];
  /** The obstacles around a spatial arm, as JSON (docs/scene.schema.json); empty: none. */
  scene: string;
  /** The distance that the arm must keep, m; 0: the default of the commands. */
  clearance: number;
  /** The arm that is dragged passes through obstacles, instead of stopping in front of them. */
  passes: boolean;
  /** The shapes of the links, where obstacles are shown. */
  showShapes: boolean;
  /** What the next map covers: cells along the diameter of the reach, and the angle between tool directions, degrees; 0:
   * the tool's orientation as it is. */
  reachCells: number;
  reachDirections: number;
  measure: Measure;
  /** The level of the surface, as a fraction of the largest value of the measure. */
  level: number;
  /** The plane of the slice: its normal, 0 x, 1 y, 2 z, and its coordinate, m; null: through the middle. */
  sliceNormal: number;
  sliceAt: number | null;
  showSurface: boolean;
  showSlice: boolean;
  lesson: string;
  /** What is shown without the surroundings: "lesson", or the name of an exercise or a figure of the lesson; empty: all. */
  only: string;
  /** Exercises have their hints and solutions. */
  help: boolean;
}

export const initialState: PageState = {
  arm: { text: "rrr" },
  q: null,
  degrees: true,
  section: "pose",
  frame: "base",
  showFrames: false,
  showAngles: true,
  showSolutions: false,
  showColumns: false,
  showEllipsoid: false,
  goal: null,
  gain: 0.1,
  ki: 0,
  kd: 0,
  waypoints: [],
  scene: "",
  clearance: 0,
  passes: false,
  showShapes: true,
  reachCells: 16,
  reachDirections: 45,
  measure: "directions",
  level: 0.5,
  sliceNormal: 2,
  sliceAt: null,
  showSurface: true,
  showSlice: true,
  lesson: "",
  only: "",
  help: true,
};

/** What Undo takes back; the others are how it is looked at. */
export const work = ["arm", "q", "goal", "gain", "ki", "kd", "waypoints", "scene", "clearance"] as const;

/** Whether two sources are the same text. */
export function sameArm(a: ArmSource, b: ArmSource): boolean {
  return "text" in a ? "text" in b && a.text === b.text : "json" in b && a.json === b.json;
}

/** The range of each gain, in its field and in an address. */
export const gainRanges = {
  gain: { min: 0.01, max: 2.5 },
  ki: { min: 0, max: 0.5 },
  kd: { min: 0, max: 1 },
};

/** What can be chosen for reachCells and reachDirections. */
export const cellChoices = [8, 12, 16, 20, 30, 40];
export const directionChoices = [90, 60, 45, 30, 0];
