import type { Trajectory } from "../src/core/trajectory.js";
import { answer } from "../src/core/command.js";
import type { Commands } from "../src/core/commands.js";
import type { Core } from "../src/core/core.js";
import { requireFiles } from "../src/core/files.js";
import { inWords } from "../src/core/words.js";
import {
  frames,
  type ChainEnds,
  type CommandResult,
  type InputFiles,
  type Frame,
  type Manipulability,
  type Matrix,
} from "../src/core/types.js";
import type { IkAnswer, LineAnswer } from "./answers.js";
import { Arm } from "./arm.js";
import { invalid, lengthOf, requireArm, requireOptions, requireType, type Numbers } from "./checks.js";
import { typedOptions, type Options } from "./options.js";
import { configuration, matrixOf, posesFile, requireInPlane, typedPose } from "./values.js";

/** A row of a Denavit-Hartenberg table, m and rad. */
export interface DhRow {
  /** revolute by default */
  type?: "revolute" | "prismatic";
  a?: number;
  alpha?: number;
  d?: number;
  theta?: number;
  limits?: { lower: number; upper: number };
}

export interface InverseOptions {
  /** The joint values that solutions are to be near; 0 by default. */
  seed?: Numbers;
  /** All solutions, up to 64; otherwise the nearest. */
  all?: boolean;
  ignoreLimits?: boolean;
}

function requireInverse({ all, ignoreLimits }: InverseOptions): void {
  requireType("all", all, "boolean");
  requireType("ignoreLimits", ignoreLimits, "boolean");
}

const maxJoints = 100; // as in beeline/model/internal/ranges.h

/** Kinematics and motion of serial arms. Radians, metres, seconds. A pose is a column-major 4 x 4 matrix, as in three.js and
 * WebGL; x,y,z,roll,pitch,yaw and x,y,z,qw,qx,qy,qz, for a planar arm also x,y,theta, are accepted too. Invalid input throws a
 * CoreError. An unreachable pose is no error: the answer has a status. */
export class Beeline {
  private commands: Promise<Commands> | null = null;

  /** @internal */
  constructor(
    private readonly core: Core,
    private readonly loadCommands: () => Promise<Commands>,
  ) {}

  /** The names of the built-in arms. */
  builtInNames(): string[] {
    return this.core.builtInNames();
  }

  /** The arm of a built-in name ("ur5"), a joint string with lengths ("RRR:3.5,3.5,2"), or the name of one of `files`:
   * .urdf, .xml (MJCF), .json. */
  readArm(arm: string, files: InputFiles = {}, ends: ChainEnds = {}): Arm {
    requireOptions("ends", ends, ["base", "tip"]);
    for (const name of ["base", "tip"] as const) requireType(name, ends[name], "string");
    const core = this.core.arm(arm, files, ends);
    return new Arm(core, { arm, files: { ...files }, ends: { ...ends } });
  }

  /** The arm of a URDF file's text, from the link `base` to the link `tip` where the tree has several ends. */
  armFromUrdf(text: string | Uint8Array, ends: ChainEnds = {}): Arm {
    return this.readArm("arm.urdf", { "arm.urdf": text }, ends);
  }

  /** The arm of Arm.toJson(). */
  armFromJson(text: string | Uint8Array): Arm {
    return this.readArm("arm.json", { "arm.json": text });
  }

  /** The arm of a Denavit-Hartenberg table. There is no default convention: the numbers do not say which it is. */
  armFromDh(name: string, rows: readonly DhRow[], convention: "standard" | "modified"): Arm {
    const count = lengthOf("rows", rows, "rows");
    if (count > maxJoints) throw invalid(`rows has ${count} rows; an arm has at most ${maxJoints} joints`);
    return this.armFromJson(JSON.stringify({ name, dh: { convention, rows } }));
  }

  /** The pose of the tool. */
  forwardKinematics(arm: Arm, q: Numbers): Matrix {
    return this.linkPoses(arm, q).at(-1) as Matrix;
  }

  /** The poses of all links, the base first, and last of the tool. */
  linkPoses(arm: Arm, q: Numbers): Matrix[] {
    requireArm(arm);
    return arm.core.forward(configuration("q", arm, q));
  }

  /** The Jacobian, rows vx vy vz wx wy wz with a number for each joint: the velocity of the tool's origin in the axes of
   * the base ("base"), in its own axes ("tool"), or the spatial twist ("space"). */
  jacobian(arm: Arm, q: Numbers, options: { frame?: Frame } = {}): number[][] {
    requireArm(arm);
    requireOptions("options", options, ["frame"]);
    const { frame = "base" } = options;
    if (!frames.includes(frame)) throw invalid(`frame is ${inWords(frame)}; it must be base, tool or space`);
    const columns = arm.core.jacobian(configuration("q", arm, q), frame);
    return Array.from({ length: 6 }, (_, row) =>
      Array.from({ length: arm.dof }, (_, k) => columns[6 * k + row] as number),
    );
  }

  /** Manipulability, condition number and singular values of the Jacobian: of x, y and theta for a planar arm. */
  manipulabilityMeasures(arm: Arm, q: Numbers): Manipulability {
    requireArm(arm);
    return arm.core.manipulability(configuration("q", arm, q));
  }

  /** The joint values with this pose of the tool, nearest to the seed first. The list is empty if there are none; ik() says
   * why. */
  inverseKinematics(arm: Arm, pose: Numbers, options: InverseOptions = {}): Float64Array[] {
    requireArm(arm);
    requireOptions("options", options, ["seed", "all", "ignoreLimits"]);
    requireInverse(options);
    const { seed, all, ignoreLimits } = options;
    const matrix = matrixOf("pose", arm, pose);
    const seedValues = seed === undefined ? new Float64Array(arm.dof) : configuration("seed", arm, seed);
    const found = arm.core.inverse(matrix, seedValues, { all: all === true, ignoreLimits: ignoreLimits === true });
    requireInPlane("pose", arm, matrix); // after the core has refused what is not rigid
    return found;
  }

  /** `beeline ik`: the solutions with status, residual and reason. Options are the command's. */
  async ik<T extends Options<T> = Options>(
    arm: Arm,
    pose: Numbers,
    options: T & InverseOptions = {} as T,
  ): Promise<IkAnswer> {
    requireArm(arm);
    requireOptions("options", options);
    requireInverse(options);
    const { seed } = options as InverseOptions;
    const seedValues = seed === undefined ? {} : { seed: configuration("seed", arm, seed) };
    if (!("task" in options)) this.inverseKinematics(arm, pose, seedValues); // refuses a pose with the same error
    return this.verb("ik", arm, { ...(options as Options), pose: typedPose("pose", arm, pose) });
  }

  /** `beeline line`: moves the tool from the joint values `from` in straight lines through poses, with a proved bound of the
   * deviation. `trajectory` is the motion, to be released; null if there is none. */
  async line<T extends Options<T> = Options>(
    arm: Arm,
    from: Numbers,
    through: readonly Numbers[],
    options: T = {} as T,
  ): Promise<LineAnswer & { trajectory: Trajectory | null }> {
    requireArm(arm);
    requireOptions("options", options);
    const files = { "poses.csv": posesFile("through", arm, through) };
    const task = { from: configuration("from", arm, from), through: "poses.csv", out: "line.csv" };
    const result = await this.runVerb("line", arm, { ...(options as Options), ...task }, files);
    const found = answer<LineAnswer>(result);
    const text = result.files["line.csv"];
    return { ...found, trajectory: text === undefined ? null : arm.core.trajectory("line.csv", text) };
  }

  /** Runs `beeline ARGS` with these files in its folder. */
  async run(args: readonly string[], files: InputFiles = {}): Promise<CommandResult> {
    if (!Array.isArray(args)) throw invalid(`args is ${inWords(args)}; it must be a list of texts`);
    for (const [i, word] of args.entries()) {
      if (typeof word !== "string") throw invalid(`args[${i}] is ${inWords(word)}; it must be a text`);
    }
    this.commands ??= this.loadCommands();
    const loaded = await this.commands.catch((error: unknown) => {
      this.commands = null; // the next call tries again
      throw error;
    });
    return loaded.run([...args], files);
  }

  /** What `beeline VERB ARM --json` prints, with options of the command in camel case: {maxSamples: 9} is --max-samples=9. */
  async verb<Answer, T extends Options<T> = Options>(
    verb: string,
    arm: Arm,
    options: T = {} as T,
    files: InputFiles = {},
  ): Promise<Answer> {
    requireArm(arm);
    requireOptions("options", options);
    return answer<Answer>(await this.runVerb(verb, arm, options as Options, files));
  }

  private async runVerb(verb: string, { source }: Arm, options: Options, files: InputFiles): Promise<CommandResult> {
    requireFiles(files);
    const args = [verb, source.arm, ...typedOptions({ ...options, ...source.ends }), "--json"];
    return this.run(args, { ...files, ...source.files });
  }
}
