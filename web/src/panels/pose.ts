import { Euler, Matrix4, Quaternion, Vector3 } from "three";
import { element, shown } from "./element.js";

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

/** The column-major 4 x 4 matrix of x y z, metres, and roll pitch yaw, radians. */
function poseOf([x = 0, y = 0, z = 0, roll = 0, pitch = 0, yaw = 0]: number[]): number[] {
  const turn = new Quaternion().setFromEuler(new Euler(roll, pitch, yaw, "ZYX"));
  return new Matrix4().compose(new Vector3(x, y, z), turn, new Vector3(1, 1, 1)).toArray();
}

const names = ["x", "y", "z", "roll", "pitch", "yaw"];
const outOfPlane = ["z", "roll", "pitch"];

/** The tool's pose in the world, in numbers that can be changed: the arm follows by inverse kinematics. */
export class PosePanel {
  readonly root = element("section", { class: "numbers", "aria-label": "Pose of the tool" });
  private readonly fields: HTMLInputElement[];
  private readonly quaternion = element("p", { class: "quiet" });
  private readonly angleUnit = element("span", { class: "unit" });
  private values: number[] = [0, 0, 0, 0, 0, 0];
  private degrees = true;

  /** `asked` gets the pose that was typed: a column-major 4 x 4 matrix. */
  constructor(asked: (pose: number[]) => void) {
    this.fields = names.map((name, i) => {
      const field = element("input", { type: "number", "aria-label": name });
      field.addEventListener("change", () => {
        if (field.value !== "") asked(poseOf(this.values.with(i, Number(field.value) / this.factor(i))));
      });
      field.addEventListener("blur", () => this.write());
      return field;
    });
    const row = (label: string, from: number, unit: HTMLElement): HTMLElement =>
      element("div", { class: "pose" }, element("span", {}, label), ...this.fields.slice(from, from + 3), unit);
    this.root.append(
      element(
        "fieldset",
        {},
        element("legend", {}, "Pose of the tool in the world"),
        row("x y z", 0, element("span", { class: "unit" }, "m")),
        row("roll pitch yaw", 3, this.angleUnit),
        this.quaternion,
      ),
    );
  }

  /** A planar arm's tool moves in x, y and yaw only. */
  describe(planar: boolean): void {
    this.fields.forEach((field, i) => (field.disabled = planar && outOfPlane.includes(names[i] ?? "")));
  }

  show(pose: ArrayLike<number>, degrees: boolean): void {
    const { position, rpy, quaternion } = poseNumbers(pose);
    this.values = [...position, ...rpy];
    this.degrees = degrees;
    this.angleUnit.textContent = degrees ? "°" : "rad";
    this.quaternion.textContent = `Quaternion w x y z: ${quaternion.map((value) => shown(value)).join("  ")}`;
    this.write();
  }

  private factor(i: number): number {
    return i >= 3 && this.degrees ? 180 / Math.PI : 1;
  }

  /** Writes the pose of the tool into the fields, except the one that has the focus. */
  private write(): void {
    this.fields.forEach((field, i) => {
      const angle = i >= 3 && this.degrees;
      field.step = angle ? "1" : "0.01";
      const value = (this.values[i] ?? 0) * this.factor(i);
      const text = value.toFixed(angle ? 2 : 4);
      if (document.activeElement !== field) field.value = text.replace(/^-(0\.0+)$/, "$1");
    });
  }
}
