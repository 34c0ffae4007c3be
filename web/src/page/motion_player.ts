import { toolPosition } from "../core/pose.js";
import type { Trajectory } from "../core/trajectory.js";
import { element } from "../elements/element.js";
import { JointCurves } from "../panels/joint_curves.js";
import { fileSaver } from "../panels/motion_report.js";
import { Player } from "../panels/player.js";
import type { Trail } from "../scene/picture.js";
import type { Services, Shown } from "./section.js";

const points = 151; // of the path of the tool in the picture
const same = 1e-4; // rad or m
const every = 5; // points from dot to dot

/** A motion of the arm that is shown: a player, curves of the joints, files, the path of the tool. */
export class MotionPlayer {
  /** Plays the motion: stands apart, where it is seen without scrolling. */
  readonly bar = element("div");
  readonly root = element("div");
  private readonly player: Player;
  private readonly curves = new JointCurves((time) => this.player.seek(time));
  private readonly files = element("p", { class: "pair" });
  private shown: Shown | null = null;
  private motion: Trajectory | null = null;
  private isPlacing = false;

  /** `retime` is called when the motion is to get new times; null: it has the shortest ones. */
  constructor(
    private readonly services: Services,
    private readonly retime: (() => void) | null,
  ) {
    this.player = new Player((q, time) => {
      this.isPlacing = true;
      services.store.set({ q });
      this.isPlacing = false;
      this.curves.point(time);
    });
  }

  take(shown: Shown): void {
    this.clear();
    this.shown = shown;
  }

  /** Shows a motion from the text of a file. Throws where the core refuses it. */
  show(name: string, text: string): void {
    const motion = (this.shown as Shown).arm.trajectory(name, text);
    this.player.take(null);
    this.motion?.release();
    this.motion = motion;
    this.showCurves();
    this.files.replaceChildren(
      fileSaver("motion.csv", () => motion.text("motion.csv"), "text/csv"),
      fileSaver("motion.json", () => motion.text("motion.json"), "application/json"),
      ...(this.retime ? [element("button", { type: "button", onclick: this.retime }, "Retime within the limits")] : []),
    );
    this.bar.replaceChildren(this.player.root);
    this.root.replaceChildren(this.files, this.curves.root);
    this.player.take(motion);
  }

  clear(): void {
    this.player.take(null);
    this.motion?.release();
    this.motion = null;
    this.bar.replaceChildren();
    this.root.replaceChildren();
    this.showCurves();
  }

  /** The path of the tool; a dot at equal times, close together where it is slow. */
  trail(tone: Trail["tone"]): Trail[] {
    const { motion, shown } = this;
    if (!motion || !shown) return [];
    const [begin, end] = [motion.times[0] ?? 0, motion.times.at(-1) ?? 0];
    const times = Array.from({ length: points }, (_, i) => begin + (i * (end - begin)) / (points - 1));
    return [{ tone, points: times.map((time) => toolPosition(shown.arm, motion.at(time))), dots: true, every }];
  }

  /** Shows the time at which the motion has the joint values of the arm; none where it does not have them. */
  follow(q: number[]): void {
    const { motion } = this;
    if (!motion || this.player.playing) return;
    const far = motion.rows().map((row) => Math.max(...row.map((value, k) => Math.abs(value - (q[k] ?? NaN)))));
    const nearest = far.reduce((best, value, i) => (value < (far[best] ?? Infinity) ? i : best), 0);
    this.player.show((far[nearest] ?? Infinity) < same ? (motion.times[nearest] ?? null) : null);
  }

  /** The joint values at the begin; null without a motion. */
  get start(): number[] | null {
    return this.motion?.row(0) ?? null;
  }

  text(): string | null {
    return this.motion?.text("motion.csv") ?? null;
  }

  /** The player moves the arm at the moment: it was no hand. */
  get places(): boolean {
    return this.isPlacing;
  }

  pause(): void {
    this.player.pause();
  }

  play(): void {
    this.player.play();
  }

  showCurves(): void {
    this.curves.take(this.motion, this.shown?.description.joints ?? [], this.services.store.get().degrees);
  }
}
