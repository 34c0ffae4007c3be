import { answer } from "../core/command.js";
import { poseOfQuaternion, sevenOf, toolPose } from "../core/pose.js";
import { element } from "../elements/element.js";
import { branchMap } from "../panels/branch_map.js";
import { branchesOf, planReport, type LineAnswer } from "../panels/motion_report.js";
import { reasonInWords, type Wording } from "../panels/reasons/reasons.js";
import { WaypointsPanel } from "../panels/waypoints.js";
import type { Mark, Trail } from "../scene/picture.js";
import type { PageState } from "../state/page_state.js";
import { MotionPlayer } from "./motion_player.js";
import { Recording } from "./recording.js";
import { Rest } from "./rest.js";
import type { PageSection, Services, Shown } from "./section.js";
import { Work } from "./work.js";

const rate = 100; // samples a second of a planned motion

/** Waypoints, and the line through them: planned and proved in the page whenever they change. A recording stands apart. */
export class LineSection implements PageSection {
  readonly root = element("div", { class: "panel" });
  readonly recording: Recording;
  private readonly intro = element(
    "p",
    { class: "quiet" },
    "Drag the tool to a pose and add it, again and again; the numbers in the picture can be dragged too. The motion " +
      "along the straight lines is planned at once, and its deviation is proved for all times.",
  );
  private readonly waypoints: WaypointsPanel;
  private readonly report = element("div", { role: "status" });
  private readonly branches = element("div");
  private readonly player: MotionPlayer;
  private readonly work: Work;
  private readonly rest = new Rest();
  private shown: Shown | null = null;
  private planned: Trail[] = [];
  /** What is reported and the map of the branches, in the units of now. */
  private reported: () => HTMLElement[] = () => [];
  private map: (() => HTMLElement) | null = null;
  private dragging = false;
  private plannedFor = "";

  constructor(private readonly services: Services) {
    const { store } = services;
    this.player = new MotionPlayer(services, () => void this.retime());
    this.work = new Work(services, (reason) => this.say(() => [element("p", { class: "refusal" }, reason)]));
    this.waypoints = new WaypointsPanel(
      () => this.toolPose(),
      (waypoints) => store.set({ waypoints }),
      () => this.changed(),
    );
    this.recording = new Recording(
      services,
      () => (this.waypoints.enough ? this.waypoints.asFile : null),
      () => this.pause(),
      () => this.draw(),
    );
    this.root.append(
      element("h2", {}, "Line"),
      this.waypoints.buttons, // nothing above them changes its height: they stay under the finger
      this.player.bar,
      this.intro,
      this.waypoints.root,
      this.work.root,
      this.report,
      this.player.root,
      this.branches,
      this.waypoints.fromFile,
      this.recording.root,
    );
  }

  take(shown: Shown): void {
    this.shown = shown;
    this.waypoints.dropFile();
    this.waypoints.describe(shown.arm.planar);
    this.player.take(shown);
    this.recording.take(shown);
    this.clear();
  }

  update(_: number[], changed: ReadonlySet<keyof PageState>): void {
    if (changed.has("q") && !this.player.places && !this.recording.places) this.pause();
    if (changed.has("degrees")) {
      this.player.showCurves();
      this.write();
      this.recording.unitsChanged();
    }
    const { waypoints, degrees } = this.services.store.get();
    this.waypoints.show(waypoints, degrees);
    this.intro.hidden = waypoints.length > 1;
    if (changed.has("waypoints") || changed.has("scene") || changed.has("clearance")) this.changed();
    else if (changed.has("section")) this.draw();
    this.recording.update();
  }

  leave(): void {
    this.pause();
  }

  interrupt(): void {
    this.pause();
  }

  waypoint(index: number, pose: number[], released: boolean): void {
    this.dragging = !released;
    const { waypoints } = this.services.store.get();
    this.services.store.set({ waypoints: waypoints.with(index, sevenOf(pose)) });
    if (released) this.changed();
  }

  private pause(): void {
    this.player.pause();
    this.recording.pause();
  }

  private clear(): void {
    this.rest.cancel();
    this.work.stop();
    this.plannedFor = "";
    this.player.clear();
    this.planned = [];
    this.map = null;
    this.say(() => []);
  }

  /** Other waypoints: the preview follows, the plan once they are dropped. */
  private changed(): void {
    this.player.bar.className = this.waypoints.enough ? "awaits-player" : "";
    if (this.waypoints.enough && !this.dragging && this.planKey === this.plannedFor) return this.draw();
    this.clear();
    this.draw();
    if (!this.waypoints.enough) {
      if (!this.waypoints.empty) this.say(() => [element("p", { class: "quiet" }, "One more waypoint makes a line.")]);
    } else if (!this.dragging) this.rest.then(() => void this.plan(null));
  }

  private draw(): void {
    const { waypoints, section } = this.services.store.get();
    if (section !== "line") return;
    const poses = waypoints.map(poseOfQuaternion);
    const marks = poses.map((pose, i): Mark => ({ pose, label: String(i + 1), held: true }));
    const preview: Trail = { tone: "preview", points: poses.map((pose) => pose.slice(12, 15)), dots: false };
    const line = this.planned.length > 0 ? this.planned : [preview];
    this.services.draw({ waypoints: marks, trails: [...line, ...this.recording.trails] });
  }

  private toolPose(): number[] | null {
    const { q } = this.services.store.get();
    return this.shown && q ? sevenOf(toolPose(this.shown.arm, q)) : null;
  }

  /** The joint values at the first waypoint with the elbow that the arm has now; null: there are none, or the
   * waypoints are of a file. */
  private heldStart(): number[] | null {
    const { waypoints, q } = this.services.store.get();
    const [first] = waypoints;
    if (!first || !q || !this.shown) return null;
    const [found] = this.shown.arm.inverse(poseOfQuaternion(first), q);
    return found ? Array.from(found) : null;
  }

  /** Plans the line; `chosen`: the joint values at the first pose of one of the branches; null: the elbow that is held,
   * or where it cannot follow the line the best branch. `note` is said in front of the report. */
  private async plan(chosen: number[] | null, note = ""): Promise<void> {
    const poses = this.waypoints.asFile;
    this.clear();
    this.plannedFor = this.planKey;
    const start = chosen ?? this.heldStart();
    const how = start ? [`--from=${start.join(",")}`] : [];
    const first = start ? 0 : 1; // with --from the path begins where the arm stands
    const args = ["line", "arm.json", `--through=${poses.name}`, `--rate=${rate}`, "--json"];
    const files = { [poses.name]: poses.text };
    let another = async (): Promise<void> => undefined;
    await this.work.run(async (progress, current) => {
      const result = await this.services.inScene([...args, ...how, "--out=motion.csv"], files, progress);
      if (!current()) return;
      const line = answer<LineAnswer>(result);
      this.say(() => [...(note === "" ? [] : [element("p", { class: "quiet" }, note)]), this.reportOf(line, first)]);
      const csv = result.files["motion.csv"];
      if (csv !== undefined) {
        this.player.show("motion.csv", csv);
        const { q } = this.services.store.get();
        if (q) this.player.follow(q);
        this.planned = this.player.trail(line.status === "reached" ? "planned" : "refused");
      }
      this.draw();
      const all = branchesOf(answer<LineAnswer>(await this.services.inScene([...args, "--branches"], files, progress)));
      if (!current()) return;
      const best = all.find(({ status }) => status === "reached");
      if (line.status !== "reached" && chosen === null && best) {
        const why = `The elbow that is held cannot follow. ${reasonInWords(line, { ...this.wording, first })}`;
        another = () => this.plan(best.start, `${why} Another one can.`);
        return;
      }
      const begin = csv === undefined ? null : this.player.start;
      if (all.length > 0)
        this.map = () => branchMap(all, Math.max(1, line.waypoints - 1), begin, this.wording, (q) => void this.plan(q));
      this.write();
    });
    await another(); // behind the run: it would cancel what others compute
  }

  /** Gives the motion new times, the shortest within the joint limits, and proves it again. */
  private async retime(): Promise<void> {
    const text = this.player.text();
    if (text === null) return;
    const poses = this.waypoints.asFile;
    await this.work.run(async (progress, current) => {
      const args = ["retime", "arm.json", "motion.csv", "--out=retimed.csv", "--json"];
      const result = await this.services.inScene(args, { "motion.csv": text }, progress);
      if (!current()) return;
      const retimed = answer<LineAnswer>(result);
      this.say(() => [this.reportOf(retimed)]);
      const csv = result.files["retimed.csv"];
      if (csv === undefined) return;
      this.player.show("motion.csv", csv);
      const check = ["check", "arm.json", "motion.csv", `--through=${poses.name}`, "--json"];
      const files = { "motion.csv": csv, [poses.name]: poses.text };
      const proof = answer<LineAnswer>(await this.services.inScene(check, files, progress));
      if (!current()) return;
      const isProved = proof.status === "passed";
      const report = isProved ? { ...proof, status: retimed.status } : retimed;
      const why = (): string => `Not proved with these times. ${reasonInWords(proof, this.wording)}`;
      this.say(() => [...(isProved ? [] : [element("p", { class: "over" }, why())]), this.reportOf(report)]);
    });
  }

  /** What a plan depends on: the poses, and the obstacles with their clearance. */
  private get planKey(): string {
    return [this.waypoints.asFile.text, this.services.surroundings()].join("\n");
  }

  private get wording(): Wording {
    return { degrees: this.services.store.get().degrees, planar: this.shown?.arm.planar === true };
  }

  private reportOf(line: LineAnswer, first = 1): HTMLElement {
    const joints = this.shown?.description.joints ?? [];
    return planReport(line, joints, { ...this.wording, first }, this.services.unchecked());
  }

  /** Shows a report, which is written again in other units. */
  private say(report: () => HTMLElement[]): void {
    this.reported = report;
    this.write();
  }

  private write(): void {
    this.report.replaceChildren(...this.reported());
    this.branches.replaceChildren(...(this.map ? [this.map()] : []));
  }
}
