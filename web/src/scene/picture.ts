import type { Arm } from "../core/arm.js";
import type { ArmDescription } from "../core/description.js";
import type { SceneBody } from "../core/scene.js";
import type { ReachGrid, ReachSurface } from "../core/reach.js";
import type { Skeleton } from "../core/types.js";
import type { PathFile } from "./mesh_files.js";

/** The arm at other joint values, pale. */
export interface Ghost {
  q: number[];
  tone: "solution" | "goal" | "start";
}

/** Whether solutions are among ghosts. */
export function hasSolutions(ghosts: Ghost[] = []): boolean {
  return ghosts.some(({ tone }) => tone === "solution");
}

/** The centre line of an arm from base to tool, m. */
export function centreLine({ base, joints, tool }: Skeleton): number[][] {
  return [base, ...joints.flatMap(({ enter, leave }) => [enter, leave]), tool];
}

/** A path of the tool, m: the tone is its colour. */
export interface Trail {
  tone: "joint" | "cartesian" | "planned" | "preview" | "refused";
  points: number[][];
  /** Whether points have dots: each one, a step; or one of `every` many. */
  dots: boolean;
  every?: number;
}

/** A numbered pose, column-major 4 x 4, which can be dragged where it is `held`. */
export interface Mark {
  pose: number[];
  label: string;
  held: boolean;
}

/** The values of a map in a plane: `normal` is its axis, `index` the cell along it; the largest value is `most`. */
export interface Tiles {
  grid: ReachGrid;
  values: Float32Array;
  normal: number;
  index: number;
  most: number;
}

/** A body among the obstacles, posed in the world, or of the arm, posed in the frame of its link. */
export interface DrawnBody extends SceneBody {
  /** The index of the link. */
  link?: number;
  hidden?: boolean;
}

/** Two points of two bodies, m, with their distance in words. `bodies`: their names. */
export interface Gap {
  points: [number[], number[]];
  text: string;
  bodies: string[];
  /** Whether they are closer than their clearance. */
  close: boolean;
}

/** What is drawn beside the arm. */
export interface Marks {
  /** The frame of each link; the frame of the tool is always drawn. */
  frames: boolean;
  /** The joint angles of a planar arm. */
  angles: boolean;
  degrees: boolean;
  /** The arm moves by itself: the values of its joints are not written. */
  moving: boolean;
  /** What the hand can take hold of: the tool and the links. */
  handle: boolean;
  /** Whether the handle turns the tool of a spatial arm, instead of moving it. */
  turning: boolean;
  ghosts: Ghost[];
  /** The ghost of the solution that is pointed at: the others are hidden. */
  pointed: number | null;
  /** The columns of the Jacobian, velocities of the tool per joint, drawn as arrows. */
  columns: number[][] | null;
  /** The same columns as the ellipsoid of velocities. */
  ellipsoid: number[][] | null;
  trails: Trail[];
  waypoints: Mark[];
  /** Points that a picture of the whole arm shows besides it, m. */
  extent: number[][];
  tiles: Tiles | null;
  surface: { mesh: ReachSurface; colour: [number, number, number] } | null;
  /** The centre and the edge of a cell of a map, m. */
  cell: { centre: number[]; edge: number } | null;
  /** The obstacles around a spatial arm, and the shapes of its links. */
  obstacles: DrawnBody[];
  linkShapes: DrawnBody[];
  /** Whether a hand can take hold of obstacles, and the index of the one that has a handle. */
  obstaclesHeld: boolean;
  selected: number | null;
  gaps: Gap[];
}

/** What a section draws, as it begins. */
export const noSectionMarks = {
  moving: false,
  pointed: null,
  trails: [],
  waypoints: [],
  extent: [],
  tiles: null,
  surface: null,
  cell: null,
  obstaclesHeld: false,
  selected: null,
};

export const noMarks: Marks = {
  frames: false,
  angles: false,
  degrees: true,
  handle: true,
  turning: false,
  ghosts: [],
  columns: null,
  ellipsoid: null,
  obstacles: [],
  linkShapes: [],
  gaps: [],
  ...noSectionMarks,
};

/** Metres that are drawn for a metre a second. */
export const shortening = 0.35;

/** What a hand does in a picture. Poses are column-major 4 x 4 matrices in the world. */
export interface Hand {
  /** The tool is to go to a pose. */
  tool(pose: number[]): void;
  /** A joint is to have a value. */
  joint(k: number, value: number): void;
  waypoint(index: number, pose: number[], released: boolean): void;
  /** A tile was clicked at this point. */
  tile(point: number[]): void;
  /** An obstacle was taken hold of, `pose` null, or is to have a pose. */
  obstacle(index: number, pose: number[] | null): void;
  pressed(): void;
  released(): void;
}

/** The picture of one arm. */
export interface Picture {
  /** What the picture spans, m. */
  readonly size: number;
  /** Shows joint values; `poses` of all links, the tool's last. */
  show(q: number[], poses: Float64Array[]): void;
  /** Draws other marks; those that are not named stay. */
  mark(change: Partial<Marks>): void;
  /** A sentence beside the tool; none where it is empty. */
  say(text: string, tone?: "hint" | "refusal"): void;
  /** Shows the whole arm. */
  home(): void;
  /** Moves the viewer away until all that the arm reaches is seen. */
  retreat(): void;
  /** The picture as a PNG; null where there is none. */
  image(): Promise<Blob | null>;
  /** Azimuth and elevation of the viewer, degrees, as `beeline draw` takes them; null for planar arms. */
  viewer(): { azimuth: number; elevation: number } | null;
  /** Shows the meshes of a URDF in place of the shapes of their links. `moved` is called after each show(). */
  showMeshes(urdf: string, links: string[], files: PathFile[], moved: () => void): Promise<MeshReport | null>;
  dispose(): void;
}

/** Which meshes are shown and where, which are missing, and what is wrong with files. */
export interface MeshReport {
  meshes: { file: string; link: string; pose(): number[] }[];
  missing: string[];
  faults: string[];
}

/** What a picture is made of. */
export interface PictureParts {
  holder: HTMLElement;
  arm: Arm;
  description: ArmDescription;
  /** The reach of the arm, m. */
  size: number;
  hand: Hand;
}
