import { tooLarge } from "./arm_chooser.js";
import { element, shown } from "./element.js";

/** The waypoints of a line: the tool's poses, added by hand, or a file of poses as commands read it. */
export class WaypointsPanel {
  readonly root = element("div");
  private readonly list = element("ol", { class: "waypoints" });
  private readonly message = element("p", { role: "alert", class: "refusal" });
  private poses: number[][] = [];
  private file: { name: string; text: string } | null = null;

  /** `pose`: the pose of the tool now, x y z qw qx qy qz; `changed` is called with other poses. */
  constructor(
    pose: () => number[] | null,
    private readonly changed: (poses: number[][]) => void,
  ) {
    const add = element("button", { type: "button" }, "Add the tool's pose");
    add.addEventListener("click", () => {
      const added = pose();
      this.file = null;
      if (added) this.changed([...this.poses, added]);
    });
    const clear = element("button", { type: "button" }, "Remove all");
    clear.addEventListener("click", () => this.removeAll());
    const load = element("input", { type: "file", accept: ".csv,.json", "aria-label": "Waypoints from a file" });
    load.addEventListener("change", () => {
      const file = load.files?.[0];
      if (file) void this.read(file);
      load.value = "";
    });
    const fromFile = element("details", {}, element("summary", {}, "or from a file of poses"), load);
    this.root.append(element("p", { class: "pair" }, add, clear), fromFile, this.message, this.list);
  }

  show(poses: number[][]): void {
    this.poses = poses;
    if (poses.length > 0) this.file = null;
    const items = this.file
      ? [this.item(`the poses of ${this.file.name}`, "Remove the file", () => this.removeAll())]
      : poses.map(([x = 0, y = 0, z = 0], i) =>
          this.item(`${shown(x, 3)}, ${shown(y, 3)}, ${shown(z, 3)} m`, `Remove waypoint ${i + 1}`, () =>
            this.changed(this.poses.filter((_, k) => k !== i)),
          ),
        );
    this.list.replaceChildren(...items);
  }

  /** Whether there is a line through them. */
  get enough(): boolean {
    return this.file !== null || this.poses.length > 1;
  }

  get empty(): boolean {
    return this.file === null && this.poses.length === 0;
  }

  /** The file of poses that commands read: its name and its text. */
  get asFile(): { name: string; text: string } {
    if (this.file) return this.file;
    const rows = this.poses.map((pose) => pose.join(","));
    return { name: "poses.csv", text: ["x,y,z,qw,qx,qy,qz", ...rows, ""].join("\n") };
  }

  /** Poses of a file belong to the arm that was shown. */
  dropFile(): void {
    this.file = null;
  }

  private async read(file: File): Promise<void> {
    this.message.textContent = tooLarge(file) ?? "";
    if (this.message.textContent !== "") return;
    const text = await file.text().catch((error: Error) => error);
    if (text instanceof Error) {
      this.message.textContent = `${file.name}: ${text.message}`;
      return;
    }
    const ending = file.name.toLowerCase().endsWith(".json") ? "json" : "csv";
    this.file = { name: `poses.${ending}`, text };
    this.changed([]);
    this.show([]);
  }

  private removeAll(): void {
    this.file = null;
    this.changed([]);
    this.show([]);
  }

  private item(text: string, label: string, remove: () => void): HTMLElement {
    const button = element("button", { type: "button", "aria-label": label }, "×");
    button.addEventListener("click", remove);
    return element("li", {}, `${text} `, button);
  }
}
