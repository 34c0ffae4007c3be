import { Matrix4, Object3D, Quaternion, Vector3 } from "three";
import { TransformControls } from "three/addons/controls/TransformControls.js";
import type { Stage } from "./stage.js";

/** What the mouse takes hold of: arrows to move the tool, rings to turn it. */
export class ToolHandle {
  private readonly target = new Object3D();
  private readonly controls: TransformControls;
  private held = false;

  /** `moved` gets the pose that the handle was dragged to: a column-major 4 x 4 matrix. */
  constructor(
    private readonly stage: Stage,
    flat: boolean,
    moved: (pose: number[]) => void,
  ) {
    this.controls = new TransformControls(stage.camera, stage.canvas);
    this.controls.size = 0.7;
    this.controls.attach(this.target);
    if (flat) this.controls.showZ = false;
    stage.scene.add(this.target, this.controls.getHelper());
    this.controls.addEventListener("dragging-changed", (event) => {
      this.held = event.value === true;
      stage.controls.enabled = !this.held;
    });
    this.controls.addEventListener("change", () => stage.changed());
    this.controls.addEventListener("objectChange", () => {
      this.target.updateMatrix();
      moved(this.target.matrix.toArray());
    });
    this.flat = flat;
  }
  private readonly flat: boolean;

  set mode(mode: "translate" | "rotate") {
    this.controls.setMode(mode);
    this.controls.showX = this.controls.showY = !(this.flat && mode === "rotate");
    this.controls.showZ = !this.flat || mode === "rotate";
  }

  set visible(visible: boolean) {
    this.controls.getHelper().visible = visible;
    this.controls.enabled = visible;
    this.stage.changed();
  }

  /** Follows the tool, unless it is being dragged. */
  follow(pose: ArrayLike<number>): void {
    if (this.held) return;
    const matrix = new Matrix4().fromArray(Array.from(pose));
    matrix.decompose(this.target.position as Vector3, this.target.quaternion as Quaternion, new Vector3());
    this.stage.changed();
  }

  dispose(): void {
    this.controls.detach();
    this.controls.dispose();
    this.target.removeFromParent();
    this.controls.getHelper().removeFromParent();
  }
}
