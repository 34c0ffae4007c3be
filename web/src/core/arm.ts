import { checked, readText, withTexts, type CoreModule } from "./module.js";
import { Trajectory } from "./trajectory.js";
import {
  CoreError,
  frames,
  type ChainEnds,
  type Frame,
  type Gains,
  type JointKind,
  type Manipulability,
  type Matrix,
  type Skeleton,
} from "./types.js";

const kinds: JointKind[] = ["revolute", "prismatic", "helical"];
const maxSolutions = 64;

/** An arm in the core's memory. Release it when it is not needed any more. */
export class Arm {
  readonly dof: number;
  /** The number of links, the base included. */
  readonly links: number;
  readonly planar: boolean;
  private readonly handle: number;
  private released = false;
  private readonly q: number;
  private readonly other: number;
  private readonly result: number;

  /** The arm as `beeline show --out` writes it. */
  readonly json: string;
  /** What `beeline show --json` prints. */
  readonly description: object;

  /** Without a text, `name` is a built-in arm or a joint string and no file's name, as the module has no files; with one, a
   * file's name, .urdf or .json. */
  constructor(
    private readonly module: CoreModule,
    name: string,
    text: string | null,
    { base = "", tip = "" }: ChainEnds,
  ) {
    const handle = withTexts(module, [name, text, base, tip], (first = 0, content = 0, second = 0, third = 0) =>
      module._beeline_arm(first, content, second, third),
    );
    this.handle = checked(module, handle, "invalid_arm");
    const buffers: number[] = [];
    const allocate = (count: number): number => {
      const buffer = module._beeline_allocate(count);
      if (buffer === 0) throw new CoreError(`the core has no memory for ${count} numbers`, "no_memory");
      buffers.push(buffer);
      return buffer;
    };
    try {
      this.json = this.text(module._beeline_arm_json(handle));
      this.description = JSON.parse(this.text(module._beeline_arm_description(handle))) as object;
      this.dof = module._beeline_arm_dof(handle);
      this.links = module._beeline_arm_links(handle);
      this.planar = module._beeline_arm_planar(handle) === 1;
      this.q = allocate(this.dof);
      this.other = allocate(Math.max(16, this.dof));
      this.result = allocate(Math.max(16 * (this.links + 1), maxSolutions * this.dof, 6 + 13 * this.links));
    } catch (error) {
      for (const buffer of buffers) module._beeline_release(buffer);
      module._beeline_arm_release(handle);
      throw error;
    }
  }

  /** Afterwards the arm refuses to compute. A second time does nothing. */
  release(): void {
    if (this.released) return;
    this.released = true;
    for (const buffer of [this.q, this.other, this.result]) this.module._beeline_release(buffer);
    checked(this.module, this.module._beeline_arm_release(this.handle));
  }

  /** Throws CoreError if the arm was released. */
  requireUnreleased(): void {
    if (this.released) throw new CoreError("the arm was released", "released");
  }

  /** The poses of all links and, last, of the tool. */
  forward(q: ArrayLike<number>): Matrix[] {
    this.put(q);
    checked(this.module, this.module._beeline_forward(this.handle, this.q, this.result));
    return Array.from({ length: this.links + 1 }, (_, i) => this.take(16 * i, 16));
  }

  /** A configuration that shows the arm well, far from singularities. */
  displayConfiguration(): number[] {
    checked(this.module, this.module._beeline_display_configuration(this.handle, this.result));
    return Array.from(this.take(0, this.dof));
  }

  /** The centre line from base to tool. */
  skeleton(q: ArrayLike<number>): Skeleton {
    this.put(q);
    const count = checked(this.module, this.module._beeline_skeleton(this.handle, this.q, this.result));
    const numbers = Array.from(this.take(0, 6 + 13 * count));
    const joints = Array.from({ length: count }, (_, i) => {
      const at = (k: number): number[] => numbers.slice(3 + 13 * i + k, 6 + 13 * i + k);
      const kind = kinds[numbers[3 + 13 * i] ?? 0] ?? "revolute";
      return { kind, direction: at(1), enter: at(4), leave: at(7), centre: at(10) };
    });
    return { base: numbers.slice(0, 3), joints, tool: numbers.slice(3 + 13 * count) };
  }

  /** The 6 x dof Jacobian, column-major, rows [vx vy vz wx wy wz]. */
  jacobian(q: ArrayLike<number>, frame: Frame = "base"): Float64Array {
    this.put(q);
    checked(this.module, this.module._beeline_jacobian(this.handle, this.q, frames.indexOf(frame), this.result));
    return this.take(0, 6 * this.dof);
  }

  manipulability(q: ArrayLike<number>): Manipulability {
    this.put(q);
    const count = checked(this.module, this.module._beeline_manipulability(this.handle, this.q, this.result));
    const [manipulability = 0, condition = 0, ...values] = this.take(0, 2 + count);
    return { manipulability, condition, singularValues: values };
  }

  /** Solutions of inverse kinematics, nearest to the seed first: one, or with `all` up to 64. An empty list says that
   * there is none; the answer of `beeline ik` has the reason. */
  inverse(
    pose: ArrayLike<number>,
    seed: ArrayLike<number>,
    options: { all?: boolean; ignoreLimits?: boolean } = {},
  ): Float64Array[] {
    if (pose.length !== 16) throw new CoreError(`a pose has 16 numbers, not ${pose.length}`);
    this.put(seed);
    this.module.HEAPF64.set(pose, this.other / 8);
    const capacity = options.all === true ? maxSolutions : 1;
    const ignore = options.ignoreLimits === true ? 1 : 0;
    const found = this.module._beeline_inverse(this.handle, this.other, this.q, ignore, capacity, this.result);
    return Array.from({ length: checked(this.module, found) }, (_, i) => this.take(this.dof * i, this.dof));
  }

  /** The joint values of joint-space PID control from q to the goal, one row a step. */
  pid(gains: Gains, q: ArrayLike<number>, goal: ArrayLike<number>, steps: number): Float64Array[] {
    this.put(q);
    this.check(goal);
    this.module.HEAPF64.set(goal, this.other / 8);
    const { kp, ki = 0, kd = 0 } = gains;
    const pid = checked(this.module, this.module._beeline_pid(this.dof, kp, ki, kd, this.q, this.other));
    const rows: Float64Array[] = [];
    try {
      for (let i = 0; i < steps; ++i) {
        checked(this.module, this.module._beeline_pid_step(pid, this.q));
        rows.push(this.module.HEAPF64.slice(this.q / 8, this.q / 8 + this.dof));
      }
    } finally {
      this.module._beeline_pid_release(pid);
    }
    return rows;
  }

  /** A trajectory of this arm, from the text of a file; joints are matched by name. */
  trajectory(name: string, text: string): Trajectory {
    this.requireUnreleased();
    return new Trajectory(this.module, this.handle, this.dof, name, text);
  }

  /** A text of the core, which returns null where it fails. */
  private text(pointer: number): string {
    checked(this.module, pointer === 0 ? -1 : 0);
    return readText(this.module, pointer);
  }

  private check(q: ArrayLike<number>): void {
    this.requireUnreleased();
    if (q.length !== this.dof) throw new CoreError(`the arm has ${this.dof} joint values, not ${q.length}`);
  }

  private put(q: ArrayLike<number>): void {
    this.check(q);
    this.module.HEAPF64.set(q, this.q / 8);
  }

  private take(from: number, count: number): Float64Array {
    const begin = this.result / 8 + from;
    return this.module.HEAPF64.slice(begin, begin + count);
  }
}
