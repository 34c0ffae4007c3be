import type { Pixel } from "../labels.js";
import type { ArmFigure } from "./arm_figure.js";
import type { Overlay } from "./overlay.js";
import type { RobotMeshes } from "./robot_meshes.js";

/** What the mouse points at, and could take hold of: an arrow or ring of the handle, the tool, a waypoint, an obstacle, a link. */
export type Pointed =
  | { what: "handle"; does: string }
  | { what: "tool"; at: Pixel }
  | { what: "waypoint"; index: number; at: Pixel }
  | { what: "obstacle"; index: number; name: string }
  | { what: "link"; joint: number };

/** Shows what the mouse points at: a hand, a word beside it, the link in the colour of its joint, a ring around others. */
export class Hover {
  /** `names`: of the joints; `changed` is called when the figure looks different. */
  constructor(
    private readonly canvas: HTMLElement,
    private readonly figure: ArmFigure,
    private readonly meshes: () => RobotMeshes | null,
    private readonly overlay: Overlay,
    private readonly names: string[],
    private readonly changed: () => void,
  ) {}

  show(pointed: Pointed | null, mouse: Pixel): void {
    if (pointed) this.canvas.dataset["hold"] = pointed.what;
    else delete this.canvas.dataset["hold"];
    this.overlay.point(this.wordOf(pointed), mouse, pointed && "at" in pointed ? pointed.at : null);
    const joint = pointed?.what === "link" ? pointed.joint : null;
    const isNew = [this.figure, this.meshes()].map((one) => one?.light(joint) === true);
    if (isNew.includes(true)) this.changed();
  }

  private wordOf(pointed: Pointed | null): string {
    switch (pointed?.what) {
      case "handle":
        return pointed.does;
      case "link":
        return this.names[pointed.joint] ?? "";
      case "obstacle":
        return pointed.name;
      case "tool":
        return "tool";
      default:
        return "";
    }
  }
}
