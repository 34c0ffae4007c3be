import { element, shown } from "../elements/element.js";
import { poseNumbers } from "../core/pose.js";
import type { MeshReport } from "../scene/picture.js";

/** Which meshes are shown and where, and in one line which are not. */
export class MeshList {
  readonly root = element("details", { hidden: true });
  private readonly summary = element("summary");
  private readonly status = element("p", { role: "status", class: "quiet" });
  private readonly list = element("ul");
  private refresh: () => void = () => undefined;

  constructor() {
    this.root.append(this.summary, this.list);
    this.root.addEventListener("toggle", () => this.moved());
  }

  /** The line, for those who do not open the list. */
  get line(): HTMLElement {
    return this.status;
  }

  say(line: string): void {
    this.status.textContent = line;
  }

  show(meshes: MeshReport["meshes"]): void {
    this.root.hidden = meshes.length === 0;
    this.summary.textContent = meshes.length === 1 ? "Frame of the mesh" : `Frames of the ${meshes.length} meshes`;
    const items = meshes.map(() => element("li"));
    this.list.replaceChildren(...items);
    this.refresh = () =>
      meshes.forEach(({ file, link, pose }, i) => {
        const { position, rpy } = poseNumbers(pose());
        const text = (values: number[]): string => values.map((value) => shown(value)).join(" ");
        (items[i] as HTMLElement).textContent =
          `${file} on ${link}: x y z ${text(position)} m, roll pitch yaw ${text(rpy)} rad`;
      });
    this.moved();
  }

  /** The arm has moved: the frames are written anew while the list is open. */
  moved(): void {
    if (this.root.open) this.refresh();
  }

  clear(): void {
    this.say("");
    this.show([]);
  }
}
