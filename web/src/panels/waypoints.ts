import { tooLarge } from "../core/limits.js";
import { headingOf, poseOfQuaternion, posesFile } from "../core/pose.js";
import { iconButton } from "../elements/button.js";
import { element, shown } from "../elements/element.js";

const same = 1e-9; // m, and of quaternions

function isSame(a: number[], b: number[]): boolean {
  return a.every((value, i) => Math.abs(value - (b[i] ?? 0)) < same);
}

/** The waypoints of a line: the tool's poses, added by hand, or a file of poses as commands read it. */
export class WaypointsPanel {
  readonly root = element("div");
  readonly buttons = element("p", { class: "pair" });
  /** Stands below what is planned. */
  readonly fromFile = element("details");
  private readonly list = element("ol", { class: "waypoints" });
  private readonly message = element("p", { role: "alert", class: "refusal" });
  private readonly clear = element("button", { type: "button", disabled: true }, "Remove all");
  private poses: number[][] = [];
  private planar = false;
  private degrees = true;
  private file: { name: string; text: string } | null = null;

  /** `pose`: the pose of the tool now, x y z qw qx qy qz; `changed` is called with other poses. */
  constructor(
    pose: () => number[] | null,
    private readonly changed: (poses: number[][]) => void,
    private readonly fileChanged: () => void,
  ) {
    const add = iconButton("add", "Add a waypoint here", "The tool's pose becomes the next waypoint", () => {
      const added = pose();
      const last = this.poses.at(-1);
      this.file = null;
      if (added && last && isSame(added, last))
        this.message.textContent = `The tool is at waypoint ${this.poses.length} already. Drag it elsewhere first.`;
      else if (added) this.changed([...this.poses, added]);
    });
    this.clear.addEventListener("click", () => this.removeAll());
    const load = element("input", { type: "file", accept: ".csv,.json", "aria-label": "Waypoints from a file" });
    load.addEventListener("change", () => {
      const file = load.files?.[0];
      if (file) void this.read(file);
      load.value = "";
    });
    this.fromFile.append(element("summary", {}, "Waypoints from a file"), load);
    this.buttons.append(add, this.clear);
    this.root.append(this.message, this.list);
  }

  /** `planar`: the tool moves in x, y and θ only. */
  describe(planar: boolean): void {
    this.planar = planar;
  }

  show(poses: number[][], degrees: boolean): void {
    this.message.textContent = ""; // the tool has moved, or the waypoints have changed
    this.poses = poses;
    this.degrees = degrees;
    if (poses.length > 0) this.file = null;
    this.clear.disabled = this.empty;
    const texts = this.file ? [`the poses of ${this.file.name}`] : poses.map((pose) => this.inWords(pose));
    const listed = [...this.list.children].map((item) => item.firstChild?.textContent);
    // Items that are the same stay: one that is pressed is not replaced while the arm moves.
    if (texts.length !== listed.length || texts.some((text, i) => text !== listed[i])) this.write(texts);
  }

  private write(texts: string[]): void {
    const items = [...this.list.children];
    const focused = items.findIndex((item) => item.contains(document.activeElement));
    const isFile = this.file !== null;
    this.list.replaceChildren(
      ...texts.map((text, i) => this.item(text, isFile ? "Remove the file" : `Remove waypoint ${i + 1}`, i)),
    );
    if (focused < 0) return;
    const next = this.list.children[Math.min(focused, texts.length - 1)] ?? this.buttons;
    next.querySelector("button")?.focus();
  }

  private inWords(pose: number[]): string {
    const [x, y, z] = pose.slice(0, 3).map((value) => shown(value, 3));
    if (!this.planar) return `${x}, ${y}, ${z} m`;
    const theta = headingOf(poseOfQuaternion(pose));
    return `${x}, ${y} m, ${this.degrees ? `${shown((theta * 180) / Math.PI, 1)}°` : `${shown(theta, 3)} rad`}`;
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
    return this.file ?? { name: "poses.csv", text: posesFile(this.poses) };
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
    this.changed([]);
    this.file = { name: `poses.${ending}`, text };
    this.show([], this.degrees);
    this.fileChanged();
  }

  private removeAll(): void {
    this.file = null;
    this.changed([]);
    this.show([], this.degrees);
    this.fileChanged();
  }

  private item(text: string, label: string, index: number): HTMLElement {
    const remove = (): void =>
      this.file ? this.removeAll() : this.changed(this.poses.filter((_, other) => other !== index));
    return element(
      "li",
      {},
      element("span", {}, text),
      element("button", { type: "button", class: "remove", "aria-label": label, title: label, onclick: remove }, "×"),
    );
  }
}
