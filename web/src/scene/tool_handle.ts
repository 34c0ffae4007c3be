import { Matrix4, Object3D, Vector3 } from "three";
import { TransformControls } from "three/addons/controls/TransformControls.js";
import type { Stage } from "./stage.js";

/** What the mouse takes hold of: arrows to move the tool, rings to turn it. */
export class ToolHandle {
  private readonly target = new Object3D();
  private readonly controls: TransformControls;
  private readonly tool = new Matrix4();
  private held = false;

  /** `flat`: for planar arms, which move in x and y and turn about z. `moved` gets the pose that the handle was dragged
   * to: a column-major 4 x 4 matrix. */
  constructor(
    private readonly stage: Stage,
    private readonly flat: boolean,
    moved: (pose: number[]) => void,
  ) {
    this.controls = new TransformControls(stage.camera, stage.canvas);
    this.controls.size = 0.7;
    this.controls.attach(this.target);
    stage.scene.add(this.target, this.controls.getHelper());
    this.controls.addEventListener("dragging-changed", (event) => {
      this.held = event.value === true;
      stage.controls.enabled = !this.held;
      if (!this.held) this.return(); // from where the tool cannot go
    });
    this.controls.addEventListener("change", () => stage.changed());
    this.controls.addEventListener("objectChange", () => {
      if (flat) this.target.position.z = this.tool.elements[14] as number; // which dragging changes by rounding
      this.target.updateMatrix();
      moved(this.target.matrix.toArray());
    });
    stage.pointAt(this.target);
  }

  set mode(mode: "translate" | "rotate") {
    this.controls.setMode(mode);
    this.controls.showX = this.controls.showY = !(this.flat && mode === "rotate");
  }

  /** Follows the tool, unless it is being dragged. */
  follow(pose: ArrayLike<number>): void {
    this.tool.fromArray(Array.from(pose));
    if (!this.held) this.return();
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
