import { Group, Vector3 } from "three";
import type { Arm } from "../core/arm.js";
import { ArmFigure, type Skeleton } from "../scene/arm_figure.js";
import { putAt, triad } from "../scene/marks.js";
import type { RobotMeshes } from "../scene/robot_meshes.js";
import { Stage } from "../scene/stage.js";
import { ToolHandle } from "../scene/tool_handle.js";

const ghostColour = 0xb07a2a;
const maxGhosts = 16;

/** The picture of one arm: itself, its frames, the handle at its tool, its other solutions as ghosts. */
export class ArmView {
  readonly stage: Stage;
  private readonly figure: ArmFigure;
  private readonly frames: Group[];
  private readonly handle: ToolHandle;
  private ghosts: ArmFigure[] = [];
  private meshes: RobotMeshes | null = null;
  private poses: Float64Array[] = [];
  private moved: () => void = () => undefined;
  private dragged: (pose: number[]) => void = () => undefined;

  /** `size`: the arm's reach; `height`: the height of its middle; metres. */
  constructor(
    holder: HTMLElement,
    private readonly arm: Arm,
    readonly size: number,
    height: number,
  ) {
    this.stage = new Stage(holder, arm.planar, size, height);
    const kinds = this.skeleton(new Array<number>(arm.dof).fill(0)).joints.map((joint) => joint.kind);
    this.figure = new ArmFigure(kinds, size);
    this.frames = Array.from({ length: arm.links + 1 }, () => triad(0.16 * size));
    this.stage.scene.add(this.figure, ...this.frames);
    this.handle = new ToolHandle(this.stage, arm.planar, (pose) => this.dragged(pose));
  }

  onDrag(dragged: (pose: number[]) => void): void {
    this.dragged = dragged;
  }

  set handleMode(mode: "translate" | "rotate") {
    this.handle.mode = mode;
  }

  /** Shows a configuration whose link poses, the tool's last, are `poses`. */
  show(q: number[], poses: Float64Array[], frames: boolean): void {
    this.figure.place(this.skeleton(q));
    this.frames.forEach((frame, i) => {
      frame.visible = frames || i === this.frames.length - 1;
      putAt(frame, poses[i] as Float64Array);
    });
    this.handle.follow(poses[poses.length - 1] as Float64Array);
    this.poses = poses;
    this.meshes?.place(poses);
    this.moved();
    this.stage.changed();
  }

  /** Shows meshes in place of the shapes of their links; `moved` is called after each show(). */
  showMeshes(meshes: RobotMeshes, moved: () => void): void {
    this.meshes?.dispose();
    this.meshes = meshes;
    this.moved = moved;
    this.figure.cover(meshes.covered);
    this.stage.scene.add(meshes);
    if (this.poses.length > 0) meshes.place(this.poses);
    this.stage.changed();
  }

  /** Shows other configurations, transparent. */
  showGhosts(configurations: number[][]): void {
    const others = configurations.slice(1, 1 + maxGhosts);
    while (this.ghosts.length > others.length) this.ghosts.pop()?.dispose();
    others.forEach((q, i) => {
      const ghost = (this.ghosts[i] ??= this.newGhost());
      ghost.visible = true;
      ghost.place(this.skeleton(q));
    });
    this.stage.changed();
  }

  /** Shows of all ghosts one, or all again. The first solution has no ghost: it is the arm itself. */
  point(index: number | null): void {
    this.ghosts.forEach((ghost, i) => (ghost.visible = index === null || i + 1 === index));
    this.stage.changed();
  }

  private newGhost(): ArmFigure {
    const ghost = new ArmFigure(this.figure.kinds, this.size, ghostColour, 0.25);
    this.stage.scene.add(ghost);
    return ghost;
  }

  dispose(): void {
    this.meshes?.dispose();
    this.handle.dispose();
    this.stage.dispose();
  }

  private skeleton(q: number[]): Skeleton {
    const { base, joints, tool } = this.arm.skeleton(q);
    const vector = (values: number[]): Vector3 => new Vector3(...values);
    return {
      base: vector(base),
      joints: joints.map((joint) => ({
        kind: joint.kind,
        direction: vector(joint.direction),
        enter: vector(joint.enter),
        leave: vector(joint.leave),
        centre: vector(joint.centre),
      })),
      tool: vector(tool),
    };
  }
}
