import { Matrix4, Vector3, type Group } from "three";
import { answer } from "../core/command.js";
import { element } from "../panels/element.js";
import { tooLarge } from "../panels/arm_chooser.js";
import { branchMap, type Branch } from "../panels/branch_map.js";
import { JointCurves } from "../panels/joint_curves.js";
import { fileSaver, planReport, waypointList, type LineAnswer } from "../panels/motion_report.js";
import { Player } from "../panels/player.js";
import { poseNumbers } from "../panels/pose.js";
import { blue, trail } from "../scene/marks.js";
import type { PageState } from "../state/page_state.js";
import type { SectionPanel, Services, Shown } from "./section.js";
import { readTrajectory, type Motion } from "../core/trajectory.js";

const rate = 100; // samples a second of a planned motion

/** Waypoints, a line through them that is planned and proved in the page, its branches, and the motion to play. */
export class MotionSection implements SectionPanel {
  readonly root = element("div", { class: "panel" });
  private readonly waypoints = element("div");
  private readonly report = element("div", { role: "status" });
  private readonly branches = element("div");
  private readonly curves = new JointCurves((time) => this.player.seek(time));
  private readonly files = element("p", { class: "pair" });
  private readonly progress = element("progress", { max: 1, value: 0, hidden: true, "aria-label": "Planning" });
  private readonly stop = element("button", { type: "button", hidden: true }, "Cancel");
  private readonly player: Player;
  private shown: Shown | null = null;
  private path: Group | null = null;
  private motion: Motion | null = null;
  private turn = 0;

  constructor(private readonly services: Services) {
    const { store } = services;
    this.player = new Player((q, time) => {
      this.place(q);
      this.curves.point(time);
    });
    this.stop.addEventListener("click", () => services.cancel());
    const add = element("button", { type: "button", onclick: () => this.addWaypoint() }, "Add the tool's pose");
    const clear = element("button", { type: "button", onclick: () => store.set({ waypoints: [] }) }, "Remove all");
    const plan = element("button", { type: "button", onclick: () => void this.plan(null) }, "Plan the line");
    const load = element("input", { type: "file", accept: ".csv,.json", "aria-label": "A trajectory, CSV or JSON" });
    load.addEventListener("change", () => {
      const file = load.files?.[0];
      if (!file) return;
      const refusal = tooLarge(file);
      if (refusal !== null) this.report.textContent = refusal;
      else void file.text().then((text) => this.open(file.name, text));
      load.value = ""; // the same file can be opened again after an edit
    });
    this.root.append(
      element("h2", {}, "A straight line, proved"),
      element(
        "p",
        { class: "quiet" },
        "Drag the tool to a pose, add it, drag on. The line through all of them is planned.",
      ),
      element("p", { class: "pair" }, add, clear),
      this.waypoints,
      element("p", { class: "pair" }, plan, this.stop),
      this.progress,
      this.report,
      this.player.root,
      this.files,
      this.curves.root,
      this.branches,
      element("h2", {}, "A motion from a file"),
      element("p", { class: "quiet" }, "It is checked against the waypoints above, and against the joint limits."),
      load,
    );
  }

  take(shown: Shown): void {
    this.shown = shown;
    this.path = null;
    this.clear();
  }

  update(q: number[], changed: ReadonlySet<keyof PageState>): void {
    const { waypoints } = this.services.store.get();
    if (changed.has("q")) this.player.pause();
    if (changed.has("degrees")) this.showCurves();
    this.place(q);
    this.waypoints.replaceChildren(
      waypointList(waypoints, (index) => {
        this.services.store.set({ waypoints: waypoints.filter((_, i) => i !== index) });
      }),
    );
  }

  leave(): void {
    this.player.pause();
    this.path?.removeFromParent();
    this.shown?.view.stage.changed();
  }

  private place(q: number[]): void {
    this.shown?.view.show(q, this.shown.arm.forward(q), this.services.store.get().showFrames);
  }

  private clear(): void {
    ++this.turn;
    if (!this.stop.hidden) this.services.cancel(); // what is planned is not wanted any more
    this.progress.hidden = this.stop.hidden = true;
    this.motion = null;
    this.player.take(null);
    this.showCurves();
    this.path?.removeFromParent();
    for (const part of [this.report, this.branches, this.files]) part.replaceChildren();
  }

  private addWaypoint(): void {
    const { q, waypoints } = this.services.store.get();
    if (!this.shown || !q) return;
    const { position, quaternion } = poseNumbers(this.shown.arm.forward(q).at(-1) as Float64Array);
    this.services.store.set({ waypoints: [...waypoints, [...position, ...quaternion]] });
  }

  /** The waypoints as the file of poses that commands read. */
  private poses(): string {
    const rows = this.services.store.get().waypoints.map((pose) => pose.join(","));
    return ["x,y,z,qw,qx,qy,qz", ...rows, ""].join("\n");
  }

  /** Plans the line; `start`: the joint values at the first pose, of one of the branches, null: those that are best for
   * all of it. */
  private async plan(start: number[] | null, branches: Branch[] = []): Promise<void> {
    const lines = this.services.store.get().waypoints.length - 1;
    if (lines < 1) {
      this.report.textContent = "A line needs two waypoints.";
      return;
    }
    this.clear();
    const turn = this.turn;
    const from = start ? [`--from=${start.join(",")}`] : ["--branches"];
    const args = ["line", "arm.json", "--through=poses.csv", ...from, "--out=motion.csv", "--json"];
    await this.during(async (report) => {
      const result = await this.services.command([...args, `--rate=${rate}`], { "poses.csv": this.poses() }, report);
      if (turn !== this.turn) return;
      const line = answer<LineAnswer>(result);
      this.report.replaceChildren(planReport(line));
      this.showFiles(result.files);
      const all = line.branches ?? branches;
      const current = (this.motion as Motion | null)?.rows[0] ?? null;
      if (all.length > 0) this.branches.replaceChildren(branchMap(all, lines, current, (q) => void this.plan(q, all)));
    });
  }

  /** Shows and checks a trajectory that somebody opened. */
  open(file: string, text: string): void {
    void this.check(file.endsWith(".json") ? "motion.json" : "motion.csv", text);
  }

  private async check(name: string, text: string): Promise<void> {
    this.clear();
    const turn = this.turn;
    await this.during(async (report) => {
      const { waypoints } = this.services.store.get();
      const files = { [name]: text, "poses.csv": this.poses() };
      const check = ["check", "arm.json", name, "--through=poses.csv", "--json"];
      if (name === "motion.csv") this.showFiles({ "motion.csv": text });
      if (waypoints.length === 0) {
        this.report.textContent =
          name === "motion.csv"
            ? "Played as it is; with waypoints above it is checked against the line through them."
            : "A JSON file is checked against the line through waypoints above; there are none. CSV files are played.";
        return;
      }
      const result = await this.services.command(check, files, report);
      if (turn === this.turn) this.report.replaceChildren(planReport(answer<LineAnswer>(result)));
    });
  }

  private showFiles(files: Record<string, string>): void {
    const csv = files["motion.csv"];
    if (csv !== undefined) {
      this.show(readTrajectory(csv, this.shown?.arm.dof ?? 0));
      this.files.replaceChildren(fileSaver("motion.csv", csv, "text/csv"));
    }
  }

  private showCurves(): void {
    this.curves.take(this.motion, this.shown?.description.joints ?? [], this.services.store.get().degrees);
  }

  private show(motion: Motion): void {
    const { arm, view } = this.shown as Shown;
    this.motion = motion;
    this.showCurves();
    const points = motion.rows.map((q) => {
      const tool = new Matrix4().fromArray(Array.from(arm.forward(q).at(-1) as Float64Array));
      return new Vector3().setFromMatrixPosition(tool);
    });
    this.path?.removeFromParent();
    this.path = trail(points, blue);
    view.stage.scene.add(this.path);
    this.player.take(motion);
    if (matchMedia("(prefers-reduced-motion: reduce)").matches) this.player.seek(0);
    else this.player.play();
  }

  /** Shows progress and a button to cancel while `work` runs, and the reason where it is refused. */
  private async during(work: (report: (fraction: number) => void) => Promise<void>): Promise<void> {
    const { turn } = this;
    this.progress.value = 0;
    this.progress.hidden = this.stop.hidden = false;
    try {
      await work((fraction) => {
        if (turn === this.turn) this.progress.value = fraction;
      });
    } catch (error) {
      if (turn === this.turn) this.report.textContent = (error as Error).message;
    } finally {
      if (turn === this.turn) this.progress.hidden = this.stop.hidden = true;
    }
  }
}
