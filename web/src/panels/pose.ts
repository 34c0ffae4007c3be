import { Euler, Matrix4, Quaternion, Vector3 } from "three";
import { element, shown, table } from "./element.js";

/** Position, roll pitch yaw (about the fixed axes x, y, z) and quaternion of a column-major 4 x 4 matrix. */
export function poseNumbers(pose: ArrayLike<number>): { position: number[]; rpy: number[]; quaternion: number[] } {
  const position = new Vector3();
  const turn = new Quaternion();
  new Matrix4().fromArray(Array.from(pose)).decompose(position, turn, new Vector3());
  const euler = new Euler().setFromQuaternion(turn, "ZYX"); // turns about fixed x, then y, then z
  const sign = turn.w < 0 ? -1 : 1;
  return {
    position: position.toArray(),
    rpy: [euler.x, euler.y, euler.z],
    quaternion: [turn.w, turn.x, turn.y, turn.z].map((value) => sign * value),
  };
}

/** The tool's pose in the world, in numbers. */
export class PosePanel {
  readonly root = element("section", { class: "numbers", tabindex: 0, "aria-label": "Pose of the tool" });

  show(pose: ArrayLike<number>, degrees: boolean): void {
    const { position, rpy, quaternion } = poseNumbers(pose);
    const factor = degrees ? 180 / Math.PI : 1;
    const unit = degrees ? "°" : "rad";
    this.root.replaceChildren(
      table(
        "Pose of the tool in the world",
        [],
        ["x y z, m", `roll pitch yaw, ${unit}`, "quaternion w x y z"],
        [
          position.map((value) => shown(value)),
          rpy.map((value) => shown(value * factor, degrees ? 2 : 4)),
          quaternion.map((value) => shown(value)),
        ],
      ),
    );
  }
}
