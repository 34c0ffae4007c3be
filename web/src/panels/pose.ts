import { poseNumbers, poseOfRpy } from "../core/pose.js";
import { element, shown, typed } from "../elements/element.js";

interface Coordinate {
  name: string;
  /** Of x y z roll pitch yaw. */
  index: number;
}
const spatial: Coordinate[] = ["x", "y", "z", "roll", "pitch", "yaw"].map((name, index) => ({ name, index }));
const planar: Coordinate[] = [
  { name: "x", index: 0 },
  { name: "y", index: 1 },
  { name: "θ", index: 5 },
];

const turns: Record<string, string> = {
  roll: "About the fixed axis x, first",
  pitch: "About the fixed axis y, second",
  yaw: "About the fixed axis z, last",
  θ: "About z, from the axis x",
};

/** The tool's pose in the world, in numbers that can be changed: the arm follows by inverse kinematics. */
export class PosePanel {
  readonly root = element("fieldset", { class: "pose", "aria-label": "Pose of the tool" });
  private readonly grid = element("div", { class: "coordinates" });
  private readonly quaternion = element("p", { class: "quiet" });
  private readonly axes = element("p", { class: "quiet" });
  private coordinates: Coordinate[] = [];
  private fields: HTMLInputElement[] = [];
  private units: HTMLElement[] = [];
  private values: number[] = [0, 0, 0, 0, 0, 0];
  private degrees = true;
  /** Numbers that were typed and not reached, in m and rad: they stay, and are asked for with the next one. */
  private readonly waiting = new Map<number, number>();

  /** `asked` gets the pose that was typed: a column-major 4 x 4 matrix. */
  constructor(private readonly asked: (pose: number[]) => void) {
    this.root.append(element("legend", {}, "Tool"), this.grid, this.quaternion, this.axes);
  }

  /** A planar arm's tool moves in x, y and θ only. */
  describe(isPlanar: boolean): void {
    this.coordinates = isPlanar ? planar : spatial;
    this.quaternion.hidden = this.axes.hidden = isPlanar;
    this.units = this.coordinates.map(() => element("span", { class: "unit", "aria-hidden": "true" }));
    this.fields = this.coordinates.map(({ name, index }, i) => {
      const field = element("input", { type: "number", id: `pose-${i}`, "aria-label": name });
      field.addEventListener("change", () => {
        if (field.value !== "") this.ask(index, Number(field.value) / this.factor(index));
      });
      field.addEventListener("blur", () => this.write());
      return field;
    });
    this.grid.replaceChildren(
      ...this.coordinates.map(({ name }, i) =>
        element(
          "div",
          { class: "coordinate" },
          element("label", { for: `pose-${i}`, ...(turns[name] && { title: turns[name] }) }, name),
          this.fields[i] as HTMLElement,
          this.units[i] as HTMLElement,
        ),
      ),
    );
  }

  show(pose: ArrayLike<number>, degrees: boolean): void {
    const { position, rpy, quaternion } = poseNumbers(pose);
    const values = [...position, ...rpy];
    if (values.some((value, i) => value !== this.values[i])) this.waiting.clear(); // the arm has moved
    this.values = values;
    this.degrees = degrees;
    this.quaternion.textContent = `Quaternion w x y z: ${quaternion.map((value) => shown(value)).join("  ")}`;
    const axis = (k: number): string => [0, 1, 2].map((i) => shown(pose[4 * k + i] ?? 0, 2)).join(", ");
    this.axes.textContent = `The tool's x axis points to (${axis(0)}), its z axis to (${axis(2)}).`;
    this.write();
  }

  private ask(index: number, value: number): void {
    this.waiting.set(index, value);
    this.asked(poseOfRpy(this.values.map((present, i) => this.waiting.get(i) ?? present)));
    for (const [i, wanted] of this.waiting) if (wanted === this.values[i]) this.waiting.delete(i);
    this.write();
  }

  private factor(index: number): number {
    return index >= 3 && this.degrees ? 180 / Math.PI : 1;
  }

  /** Writes the pose of the tool into the fields, except the one that has the focus and those whose numbers wait. */
  private write(): void {
    this.coordinates.forEach(({ index }, i) => {
      const field = this.fields[i] as HTMLInputElement;
      const angle = index >= 3 && this.degrees;
      (this.units[i] as HTMLElement).textContent = index < 3 ? "m" : this.degrees ? "°" : "rad";
      field.step = angle ? "1" : "0.01";
      const waits = this.waiting.has(index);
      if (waits) field.setAttribute("aria-invalid", "true");
      else field.removeAttribute("aria-invalid");
      const value = (this.waiting.get(index) ?? this.values[index] ?? 0) * this.factor(index);
      if (document.activeElement !== field) field.value = typed(value, angle ? 2 : 4);
    });
  }
}
