import { Matrix4, Mesh, Object3D, Vector3, type BufferGeometry } from "three";
import { TransformControls } from "three/addons/controls/TransformControls.js";
import { resolved } from "../colours.js";
import type { Stage } from "./stage.js";

/** Leaves of the arrows those that point along the axes; the tool itself is dragged in the plane of the screen. */
function simplify(helper: Object3D): void {
  const [translate, , , picker] = helper.children[0]?.children ?? [];
  for (const group of [translate, picker]) {
    for (const part of [...(group?.children ?? [])]) {
      const { geometry } = part as Mesh<BufferGeometry>;
      geometry.computeBoundingSphere();
      const { x = 0, y = 0, z = 0 } = geometry.boundingSphere?.center ?? {};
      if (!["X", "Y", "Z"].includes(part.name) || Math.min(x, y, z) < -0.05) part.removeFromParent();
    }
  }
}

/** What the mouse takes hold of: neutral arrows to move the tool, rings to turn it. */
export class ToolHandle {
  private readonly target = new Object3D();
  private readonly controls: TransformControls;
  private readonly tool = new Matrix4();
  private held = false;

  /** `moved` gets the pose that the handle was dragged to, a column-major 4 x 4 matrix; `grasped` whether it is held. */
  constructor(
    private readonly stage: Stage,
    moved: (pose: number[]) => void,
    grasped: (held: boolean) => void,
  ) {
    this.controls = new TransformControls(stage.camera, stage.canvas);
    this.controls.size = 0.8;
    simplify(this.controls.getHelper());
    this.controls.attach(this.target);
    stage.scene.add(this.target, this.controls.getHelper());
    this.controls.addEventListener("dragging-changed", (event) => {
      this.held = event.value === true;
      stage.controls.enabled = !this.held;
      grasped(this.held);
      if (!this.held) this.return(); // from where the tool cannot go
    });
    this.controls.addEventListener("change", () => stage.changed());
    this.controls.addEventListener("objectChange", () => {
      this.target.updateMatrix();
      moved(this.target.matrix.toArray());
    });
    this.paint();
  }

  set turning(turning: boolean) {
    this.controls.setMode(turning ? "rotate" : "translate");
  }

  set visible(visible: boolean) {
    this.controls.enabled = visible;
    this.controls.getHelper().visible = visible;
  }

  get dragged(): boolean {
    return this.held;
  }

  /** What the arrow or ring does that the mouse points at; empty: it points at none. */
  get pointed(): string {
    const { axis } = this.controls;
    if (axis === null || !this.controls.enabled) return "";
    if (this.controls.getMode() === "translate") return axis.toLowerCase();
    if (axis === "XYZE") return "turn freely";
    return axis === "E" ? "turn in the plane of the screen" : `turn about ${axis.toLowerCase()}`;
  }

  /** Whether the mouse points at one of its arrows or rings, or holds it. */
  get taken(): boolean {
    return this.held || (this.controls.enabled && this.controls.axis !== null);
  }

  paint(): void {
    const neutral = resolved("--handle");
    this.controls.setColors(neutral, neutral, neutral, resolved("--accent"));
  }

  /** Follows the tool, unless it is being dragged. */
  follow(pose: ArrayLike<number>): void {
    this.tool.fromArray(Array.from(pose));
    if (!this.held) this.return();
  }

  /** Points of what is seen of it, m. */
  points(): Vector3[] {
    if (!this.controls.enabled) return [];
    const { camera } = this.stage;
    const at = this.target.position;
    // As TransformControls makes it as large everywhere in the picture.
    const unit =
      (at.distanceTo(camera.position) * 1.9 * Math.tan((camera.fov * Math.PI) / 360) * this.controls.size) / 4;
    if (this.controls.getMode() === "translate")
      return [0, 1, 2].flatMap((axis) =>
        [0.2, 0.3, 0.4, 0.5, 0.6].map((far) => at.clone().setComponent(axis, at.getComponent(axis) + far * unit)),
      );
    const turn = camera.quaternion;
    const ring = Array.from({ length: 24 }, (_, i) => (i * Math.PI) / 12);
    return [0.25, 0.5].flatMap((far) =>
      ring.map((angle) =>
        new Vector3(Math.cos(angle), Math.sin(angle), 0)
          .multiplyScalar(far * unit)
          .applyQuaternion(turn)
          .add(at),
      ),
    );
  }

  dispose(): void {
    this.controls.detach();
    this.controls.dispose();
    this.target.removeFromParent();
    this.controls.getHelper().removeFromParent();
  }

  private return(): void {
    this.tool.decompose(this.target.position, this.target.quaternion, new Vector3());
    this.stage.changed();
  }
}
