import type { Raycaster } from "three";
import { poseOfBody } from "../../core/scene.js";
import type { Hand, Marks } from "../picture.js";
import { Bodies } from "./bodies.js";
import { GapLines } from "./gap_lines.js";
import type { Stage } from "./stage.js";
import { ToolHandle } from "./tool_handle.js";

/** The obstacles around an arm, the shapes of its links, the line between the nearest two bodies, and the handle of the
 * obstacle that is selected. */
export class Surroundings {
  private readonly obstacles: Bodies;
  private readonly links: Bodies;
  private readonly gaps = new GapLines();
  private readonly handle: ToolHandle;
  private marks: Pick<Marks, "obstacles" | "obstaclesHeld" | "selected"> = {
    obstacles: [],
    obstaclesHeld: false,
    selected: null,
  };

  constructor(
    private readonly stage: Stage,
    size: number,
    hand: Hand,
  ) {
    this.obstacles = new Bodies("obstacle", size);
    this.links = new Bodies("link", size);
    stage.scene.add(this.links, this.obstacles, this.gaps);
    this.handle = new ToolHandle(
      stage,
      (pose) => {
        if (this.marks.selected !== null) hand.obstacle(this.marks.selected, pose);
      },
      (held) => (held ? hand.pressed() : hand.released()),
    );
  }

  /** `poses`: of all links. */
  mark(change: Partial<Marks>, marks: Marks, poses: ArrayLike<number>[]): void {
    this.marks = marks;
    const { obstacles, linkShapes, selected, gaps, turning } = marks;
    if ("obstacles" in change) this.obstacles.show(obstacles);
    if ("linkShapes" in change) {
      this.links.show(linkShapes);
      this.links.place(poses);
    }
    const close = gaps.flatMap((gap) => (gap.close ? gap.bodies : []));
    this.obstacles.mark(close, selected);
    this.links.mark(close, null);
    this.gaps.show(gaps);
    this.handle.turning = turning;
    const body = selected === null ? undefined : obstacles[selected];
    this.handle.visible = body !== undefined;
    if (body) this.handle.follow(poseOfBody(body));
  }

  place(poses: ArrayLike<number>[]): void {
    this.links.place(poses);
  }

  get taken(): boolean {
    return this.handle.taken;
  }

  /** What the arrow or ring does that the mouse points at. */
  get pointed(): string {
    return this.handle.pointed;
  }

  /** The obstacle that a hand would take hold of, with its distance from the viewer. */
  at(ray: Raycaster): { index: number; name: string; distance: number } | null {
    if (!this.marks.obstaclesHeld) return null;
    for (const { object, distance } of ray.intersectObject(this.obstacles, true)) {
      const index = this.obstacles.indexOf(object);
      const body = index === null ? undefined : this.marks.obstacles[index];
      if (index !== null && body && body.hidden !== true) return { index, name: body.name, distance };
    }
    return null;
  }

  pose(index: number): number[] {
    const body = this.marks.obstacles[index];
    return body ? poseOfBody(body) : [];
  }

  /** Takes the colours of the page, light or dark. */
  paint(gaps: Marks["gaps"]): void {
    this.obstacles.paint();
    this.links.paint();
    this.handle.paint();
    this.gaps.show(gaps);
    this.stage.changed();
  }

  dispose(): void {
    for (const part of [this.obstacles, this.links, this.gaps, this.handle]) part.dispose();
  }
}
