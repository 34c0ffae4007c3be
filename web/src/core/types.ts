/** A 4 x 4 homogeneous matrix, column-major as in three.js, metres. */
export type Matrix = Float64Array;

/** The frames of a Jacobian, in the order of the core. */
export const frames = ["base", "tool", "space"] as const;
export type Frame = (typeof frames)[number];

export type JointKind = "revolute" | "prismatic" | "helical";

/** An arm's centre line, metres, in the world: it meets the axis of each joint at `enter` and leaves it at `leave`. */
export interface Skeleton {
  base: number[];
  joints: { kind: JointKind; direction: number[]; enter: number[]; leave: number[]; centre: number[] }[];
  tool: number[];
}

/** Links of a URDF file between which the arm is; see --base and --tip of the command line. */
export interface ChainEnds {
  base?: string;
  tip?: string;
}

export interface Manipulability {
  manipulability: number;
  condition: number;
  singularValues: number[];
}

export interface Gains {
  kp: number;
  ki?: number;
  kd?: number;
}

/** Files by name, such as {"arm.urdf": "<robot …"}. */
export type Files = Record<string, string>;
/** Files that a command reads; meshes are bytes. */
export type InputFiles = Record<string, string | Uint8Array>;

/** What a command of the command line left: `beeline VERB …`. */
export interface CommandResult {
  /** 0 yes, 1 the computed answer is no, 2 bad usage, 3 bad input file. */
  code: number;
  stdout: string;
  /** Reasons and warnings, without the progress. */
  stderr: string;
  /** The message of bad usage or a bad input file; otherwise empty. */
  refusal: string;
  /** The files that the command wrote. */
  files: Files;
}

/** Why a call failed. */
export type ErrorCode =
  | "invalid_argument" // of a function
  | "invalid_arm" // a name, a joint string or the text of a file
  | "invalid_trajectory" // the text of a file
  | "invalid_usage" // the command's exit code 2: its words and options
  | "invalid_file" // the command's exit code 3: a file that it reads
  | "released" // an arm or a trajectory was released
  | "no_memory" // for the numbers and texts of a call
  | "not_loaded"; // a WebAssembly module cannot be read or compiled, or this browser lacks what it needs

/** The message of the core, in the words of the command line. */
export class CoreError extends Error {
  override name = "CoreError";
  constructor(
    message: string,
    readonly code: ErrorCode = "invalid_argument",
  ) {
    super(message);
  }
}

/** A computation was ended from outside, which needs no words. */
export class Cancelled extends CoreError {
  override name = "Cancelled";
}
