import { Matrix4, Vector3, type Group } from "three";
import { answer } from "../core/command.js";
import type { Trajectory } from "../core/trajectory.js";
import { element } from "../panels/element.js";
import { tooLarge } from "../panels/arm_chooser.js";
import { branchMap, type Branch } from "../panels/branch_map.js";
import { JointCurves } from "../panels/joint_curves.js";
import { fileSaver, planReport, type LineAnswer } from "../panels/motion_report.js";
import { Player } from "../panels/player.js";
import { poseNumbers } from "../panels/pose.js";
import { Recorder, type Recorded } from "../panels/recorder.js";
import { WaypointsPanel } from "../panels/waypoints.js";
import { blue, trail } from "../scene/marks.js";
import type { PageState } from "../state/page_state.js";
import type { SectionPanel, Services, Shown } from "./section.js";

const rate = 100; // samples a second of a planned motion
const mostPoints = 2000; // of the path of the tool in the picture

/** Waypoints, a line through them that is planned and proved in the page, its branches, and the motion to play. */
export class MotionSection implements SectionPanel {
  readonly root = element("div", { class: "panel" });
  private readonly waypoints: WaypointsPanel;
  private readonly report = element("div", { role: "status" });
  private readonly branches = element("div");
  private readonly curves = new JointCurves((time) => this.player.seek(time));
  private readonly files = element("p", { class: "pair" });
  private readonly progress = element("progress", { max: 1, value: 0, hidden: true, "aria-label": "Progress" });
  private readonly stop = element("button", { type: "button", hidden: true }, "Cancel");
  private readonly player: Player;
  private shown: Shown | null = null;
  private path: Group | null = null;
  private motion: Trajectory | null = null;
  private turn = 0;
  private readonly recorder: Recorder;
  /** Stands beside the picture in all sections. */
  readonly light: HTMLElement;

  constructor(private readonly services: Services) {
    const { store } = services;
    this.player = new Player((q, time) => {
      this.place(q);
      this.curves.point(time);
    });
    this.recorder = new Recorder(
      () => store.get().q,
      (samples) => this.openRecorded(samples),
    );
    this.light = this.recorder.light;
    store.subscribe(({ q }, changed) => {
      if (changed.has("q") && q) this.recorder.take(q);
    });
    this.stop.addEventListener("click", () => services.cancel());
    this.waypoints = new WaypointsPanel(
      () => this.toolPose(),
      (waypoints) => store.set({ waypoints }),
    );
    const plan = element("button", { type: "button", onclick: () => void this.plan(null) }, "Plan the line");
    const load = element("input", { type: "file", accept: ".csv,.json", "aria-label": "A trajectory, CSV or JSON" });
    load.addEventListener("change", () => {
      const file = load.files?.[0];
      if (file) void this.read(file);
      load.value = ""; // the same file can be opened again after an edit
    });
    this.root.append(
      element("h2", {}, "A straight line, proved"),
      element(
        "p",
        { class: "quiet" },
        "Drag the tool to a pose, add it, drag on. The line through all of them is planned.",
      ),
      this.waypoints.root,
      element("p", { class: "pair" }, plan, this.stop),
      this.progress,
      this.report,
      this.player.root,
      this.files,
      this.curves.root,
      this.branches,
      element("h2", {}, "A motion by hand or from a file"),
      element(
        "p",
        { class: "quiet" },
        "While it records, sliders, the tool dragged by hand or a program move the arm. A motion is checked against the " +
          "joint limits and, where there are waypoints above, against the line through them.",
      ),
      element("p", { class: "pair" }, this.recorder.button, load),
    );
  }

  take(shown: Shown): void {
    this.shown = shown;
    this.path = null;
    this.waypoints.dropFile();
    this.recorder.drop();
    this.clear();
  }

  update(q: number[], changed: ReadonlySet<keyof PageState>): void {
    if (changed.has("q")) this.player.pause();
    if (changed.has("degrees")) this.showCurves();
    this.place(q);
    this.waypoints.show(this.services.store.get().waypoints);
    if (changed.has("waypoints")) this.branches.replaceChildren(); // they are of the path before
    if (this.path && this.path.parent === null) this.shown?.view.stage.scene.add(this.path); // after another section
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
    this.player.take(null);
    this.motion?.release();
    this.motion = null;
    this.showCurves();
    this.path?.removeFromParent();
    for (const part of [this.report, this.branches, this.files]) part.replaceChildren();
  }

  private toolPose(): number[] | null {
    const { q } = this.services.store.get();
    if (!this.shown || !q) return null;
    const { position, quaternion } = poseNumbers(this.shown.arm.forward(q).at(-1) as Float64Array);
    return [...position, ...quaternion];
  }

  /** Plans the line; `start`: the joint values at the first pose, of one of the branches, null: those that are best for
   * all of it. */
  private async plan(start: number[] | null, branches: Branch[] = []): Promise<void> {
    if (!this.waypoints.enough) {
      this.report.textContent = "A line needs two waypoints.";
      return;
    }
    this.clear();
    const turn = this.turn;
    const from = start ? [`--from=${start.join(",")}`] : ["--branches"];
    const poses = this.waypoints.asFile;
    const args = ["line", "arm.json", `--through=${poses.name}`, ...from, "--out=motion.csv", "--json"];
    await this.during(async (report) => {
      const result = await this.services.command([...args, `--rate=${rate}`], { [poses.name]: poses.text }, report);
      if (turn !== this.turn) return;
      const line = answer<LineAnswer>(result);
      this.report.replaceChildren(planReport(line));
      const csv = result.files["motion.csv"];
      if (csv !== undefined) this.show("motion.csv", csv);
      const all = line.branches ?? branches;
      const current = (this.motion as Trajectory | null)?.row(0) ?? null;
      if (all.length > 0)
        this.branches.replaceChildren(
          branchMap(all, Math.max(1, line.waypoints - 1), current, (q) => void this.plan(q, all)),
        );
    });
  }

  private async read(file: File): Promise<void> {
    this.clear();
    const turn = this.turn;
    const refusal = tooLarge(file);
    if (refusal !== null) {
      this.report.textContent = refusal;
      return;
    }
    try {
      const text = await file.text();
      if (turn === this.turn) this.open(file.name, text); // else another file was chosen
    } catch (error) {
      this.report.textContent = `${file.name}: ${(error as Error).message}`;
    }
  }

  /** Shows and checks a trajectory that somebody opened. */
  open(file: string, text: string): void {
    void this.check(file.toLowerCase().endsWith(".json") ? "motion.json" : "motion.csv", text);
  }

  private openRecorded(samples: Recorded[]): void {
    const names = this.shown?.description.joints.map(({ name }) => name) ?? [];
    const rows = samples.map(({ time, q }) => [time, ...q].join(","));
    this.services.store.set({ section: "motion" });
    void this.check("motion.csv", [["t", ...names].join(","), ...rows, ""].join("\n"));
  }

  private async check(name: string, text: string): Promise<void> {
    this.clear();
    const turn = this.turn;
    await this.during(async (report) => {
      await new Promise((resolve) => setTimeout(resolve)); // the progress is drawn before a long file is read
      if (turn !== this.turn) return;
      this.show(name, text);
      const poses = this.waypoints.empty ? null : this.waypoints.asFile;
      const verb = poses ? ["check", "arm.json", name, `--through=${poses.name}`] : ["replay", "arm.json", name];
      const result = await this.services.command(
        [...verb, "--json"],
        { [name]: text, ...(poses && { [poses.name]: poses.text }) },
        report,
      );
      if (turn === this.turn) this.report.replaceChildren(planReport(answer<LineAnswer>(result)));
    });
  }

  /** Gives the motion new times, the shortest within the joint limits. */
  private async retime(): Promise<void> {
    const text = this.motion?.text("motion.csv");
    if (text === undefined) return;
    this.clear();
    const turn = this.turn;
    await this.during(async (report) => {
      this.show("motion.csv", text); // stays where retiming is refused
      const args = ["retime", "arm.json", "motion.csv", "--out=retimed.csv", "--json"];
      const result = await this.services.command(args, { "motion.csv": text }, report);
      if (turn !== this.turn) return;
      this.report.replaceChildren(planReport(answer<LineAnswer>(result)));
      const csv = result.files["retimed.csv"];
      if (csv !== undefined) this.show("motion.csv", csv);
    });
  }

  private showCurves(): void {
    this.curves.take(this.motion, this.shown?.description.joints ?? [], this.services.store.get().degrees);
  }

  private show(name: string, text: string): void {
    const { arm, view } = this.shown as Shown;
    const motion = arm.trajectory(name, text);
    this.player.take(null);
    this.motion?.release();
    this.motion = motion;
    this.showCurves();
    this.files.replaceChildren(
      fileSaver("motion.csv", () => motion.text("motion.csv"), "text/csv"),
      fileSaver("motion.json", () => motion.text("motion.json"), "application/json"),
      element("button", { type: "button", onclick: () => void this.retime() }, "Retime within the limits"),
    );
    const count = Math.min(mostPoints, motion.size);
    const points = Array.from({ length: count }, (_, i) => {
      const q = motion.row(Math.round((i * (motion.size - 1)) / Math.max(1, count - 1)));
      const tool = new Matrix4().fromArray(Array.from(arm.forward(q).at(-1) as Float64Array));
      return new Vector3().setFromMatrixPosition(tool);
    });
    this.path?.removeFromParent();
    this.path = trail(points, blue);
    view.stage.scene.add(this.path);
    this.player.take(motion);
    if (matchMedia("(prefers-reduced-motion: reduce)").matches) this.player.seek(motion.times[0] ?? 0);
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
