import { answer } from "../core/command.js";
import { tooLarge } from "../core/limits.js";
import { element } from "../elements/element.js";
import { reducedMotion } from "../elements/motion.js";
import { exceedsLimits, type LineAnswer } from "../panels/motion_report.js";
import { Recorder, type Recorded } from "../panels/recorder.js";
import type { Trail } from "../scene/picture.js";
import { MotionPlayer } from "./motion_player.js";
import { ReportedMotion } from "./reported_motion.js";
import type { Services, Shown } from "./section.js";

type PosesFile = { name: string; text: string };

/** A motion by hand, by a program or from a file, played as controllers play it and checked against the joint limits;
 * against the line only when that is asked for. */
export class Recording {
  readonly root: HTMLElement;
  trails: Trail[] = [];
  /** Stands beside the picture in all sections. */
  readonly light: HTMLElement;
  private readonly compare: HTMLButtonElement;
  private readonly player: MotionPlayer;
  private readonly recorder: Recorder;
  private readonly report: ReportedMotion;
  private shown: Shown | null = null;
  private text: { name: string; content: string } | null = null;
  /** What the report depends on: the obstacles with their clearance, and whether the line is a part of it. */
  private checkedIn = "";
  private isCompared = false;

  /** `line`: the waypoints of the line; null: there is none. `begins` is called before a motion is shown, `drawn` when
   * its trails are others. */
  constructor(
    private readonly services: Services,
    private readonly line: () => PosesFile | null,
    private readonly begins: () => void,
    private readonly drawn: () => void,
  ) {
    const { store } = services;
    this.player = new MotionPlayer(services, () => void this.retime());
    this.report = new ReportedMotion(services);
    this.recorder = new Recorder(
      () => store.get().q,
      (samples) => this.openRecorded(samples),
    );
    this.light = this.recorder.light;
    store.subscribe(({ q }, changed) => {
      if (changed.has("q") && q) this.recorder.take(q);
    });
    const load = element("input", { type: "file", accept: ".csv,.json", "aria-label": "A trajectory, CSV or JSON" });
    load.addEventListener("change", () => {
      const file = load.files?.[0];
      if (file) void this.read(file);
      load.value = ""; // the same file can be opened again after an edit
    });
    this.compare = element("button", { type: "button", hidden: true }, "Check against the line");
    this.compare.addEventListener("click", () => void this.check(this.line()));
    this.root = element(
      "section",
      { class: "recording", "aria-label": "Recording" },
      element("h3", {}, "Recording"),
      element(
        "p",
        { class: "quiet" },
        "While it records, sliders, the hand or a program move the arm. A recording, or a file, is checked against the " +
          "limits of the joints.",
      ),
      element("p", { class: "pair" }, this.recorder.button, load),
      this.report.work.root,
      this.report.root,
      element("p", { class: "pair" }, this.compare),
      this.player.bar,
      this.player.root,
    );
  }

  take(shown: Shown): void {
    this.shown = shown;
    this.recorder.drop();
    this.player.take(shown);
    this.report.take(shown);
    this.clear();
  }

  /** Shows and checks a trajectory that somebody opened. */
  open(file: string, content: string): void {
    this.clear();
    this.begins();
    this.text = { name: file.toLowerCase().endsWith(".json") ? "motion.json" : "motion.csv", content };
    void this.check(null);
  }

  /** Checks the motion again where the obstacles or their clearance are others. */
  update(): void {
    if (!this.text || this.services.surroundings() === this.checkedIn) return;
    const isNew = this.trails.length === 0;
    this.report.show(null);
    this.trails = this.player.trail("planned");
    this.drawn();
    void this.check(this.isCompared ? this.line() : null, isNew);
  }

  get places(): boolean {
    return this.player.places;
  }

  pause(): void {
    this.player.pause();
  }

  unitsChanged(): void {
    this.player.showCurves();
    this.report.unitsChanged();
  }

  private clear(): void {
    this.report.work.stop();
    this.player.clear();
    this.text = null;
    this.compare.hidden = true;
    this.trails = [];
    this.report.show(null);
  }

  private async read(file: File): Promise<void> {
    const refusal = tooLarge(file);
    if (refusal !== null) {
      this.clear();
      return this.report.refuse(refusal);
    }
    try {
      this.open(file.name, await file.text());
    } catch (error) {
      this.report.refuse(`${file.name}: ${(error as Error).message}`);
    }
  }

  private openRecorded(samples: Recorded[]): void {
    const names = this.shown?.description.joints.map(({ name }) => name) ?? [];
    const rows = samples.map(({ time, q }) => [time, ...q].join(","));
    this.services.store.set({ section: "line" });
    this.open("motion.csv", [["t", ...names].join(","), ...rows, ""].join("\n"));
  }

  /** Checks the motion against the limits, or against a line too. `isNew`: it is shown and played. */
  private async check(poses: PosesFile | null, isNew = poses === null): Promise<void> {
    const { text } = this;
    if (!text) return;
    this.checkedIn = this.services.surroundings();
    this.isCompared = poses !== null;
    await this.report.work.run(async (progress, current) => {
      await new Promise((resolve) => setTimeout(resolve)); // the progress is drawn before a long file is read
      if (!current()) return;
      if (isNew) this.show(text.name, text.content);
      const verb = poses
        ? ["check", "arm.json", text.name, `--through=${poses.name}`]
        : ["replay", "arm.json", text.name];
      const files = { [text.name]: text.content, ...(poses && { [poses.name]: poses.text }) };
      const result = await this.services.inScene([...verb, "--json"], files, progress);
      if (current()) this.judge(answer<LineAnswer>(result));
    });
  }

  private judge(found: LineAnswer): void {
    this.report.show(found);
    this.compare.hidden = this.line() === null;
    if (exceedsLimits(found)) this.draw("refused");
  }

  private draw(tone: Trail["tone"]): void {
    this.trails = this.player.trail(tone);
    this.drawn();
  }

  private show(name: string, text: string): void {
    this.player.show(name, text);
    this.draw("planned");
    if (!reducedMotion()) this.player.play();
  }

  /** Gives the motion new times, the shortest within the joint limits. */
  private async retime(): Promise<void> {
    const text = this.player.text();
    if (text === null) return;
    this.player.pause();
    this.checkedIn = this.services.surroundings();
    this.isCompared = false;
    await this.report.work.run(async (progress, current) => {
      const args = ["retime", "arm.json", "motion.csv", "--out=retimed.csv", "--json"];
      const result = await this.services.inScene(args, { "motion.csv": text }, progress);
      if (!current()) return;
      const csv = result.files["retimed.csv"];
      if (csv !== undefined) {
        this.text = { name: "motion.csv", content: csv };
        this.show("motion.csv", csv);
      }
      this.judge(answer<LineAnswer>(result));
    });
  }
}
