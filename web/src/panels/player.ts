import type { Trajectory } from "../core/trajectory.js";
import { element } from "../elements/element.js";
import { icon } from "../elements/icons.js";

/** Plays a motion, once or again and again: a time bar, play and pause. */
export class Player {
  readonly root = element("div", { class: "player", hidden: true });
  private readonly bar = element("input", { type: "range", min: 0, step: "any", "aria-label": "Time, seconds" });
  private readonly word = element("span", {}, "Play");
  private readonly button = element("button", { type: "button", class: "icon-button" }, icon("play"), this.word);
  private readonly loop = element(
    "button",
    { type: "button", class: "icon-button", "aria-pressed": "false", title: "Play again and again" },
    icon("loop"),
    element("span", {}, "Loop"),
  );
  private readonly clock = element("output");
  private motion: Trajectory | null = null;
  private frame: number | null = null;

  constructor(private readonly place: (q: number[], time: number) => void) {
    this.bar.addEventListener("input", () => {
      this.pause();
      this.go();
    });
    this.button.addEventListener("click", () => (this.frame === null ? this.play() : this.pause()));
    this.loop.addEventListener("click", () => this.loop.setAttribute("aria-pressed", String(!this.loops)));
    this.root.append(this.button, this.loop, this.bar, this.clock);
  }

  private get loops(): boolean {
    return this.loop.getAttribute("aria-pressed") === "true";
  }

  get playing(): boolean {
    return this.frame !== null;
  }

  take(motion: Trajectory | null): void {
    this.pause();
    this.motion = motion;
    this.root.hidden = motion === null;
    this.bar.min = this.bar.value = String(motion?.times[0] ?? 0);
    this.bar.max = String(motion?.times.at(-1) ?? 0);
  }

  play(): void {
    if (!this.motion) return;
    this.pause();
    const end = Number(this.bar.max);
    if (Number(this.bar.value) >= end) this.bar.value = this.bar.min;
    let begin = performance.now() - 1000 * Number(this.bar.value);
    this.word.textContent = "Pause";
    this.button.replaceChild(icon("pause"), this.button.firstChild as Node);
    const step = (): void => {
      const time = Math.min(end, (performance.now() - begin) / 1000);
      this.bar.value = String(time);
      this.go();
      if (time >= end && this.loops) begin = performance.now() - 1000 * Number(this.bar.min);
      if (time >= end && !this.loops) this.pause();
      else this.frame = requestAnimationFrame(step);
    };
    this.frame = requestAnimationFrame(step);
  }

  /** Stops and shows a time. */
  seek(time: number): void {
    this.pause();
    this.bar.value = String(time);
    this.go();
  }

  /** Shows a time without moving the arm; null: the arm is beside the motion. */
  show(time: number | null): void {
    this.bar.value = time === null ? this.bar.min : String(time);
    this.clock.textContent = time === null ? "" : `${time.toFixed(2)} s`;
  }

  pause(): void {
    if (this.frame !== null) cancelAnimationFrame(this.frame);
    this.frame = null;
    if (this.word.textContent === "Play") return;
    this.word.textContent = "Play";
    this.button.replaceChild(icon("play"), this.button.firstChild as Node);
  }

  private go(): void {
    if (!this.motion) return;
    const time = Number(this.bar.value);
    this.clock.textContent = `${time.toFixed(2)} s`;
    this.place(this.motion.at(time), time);
  }
}
