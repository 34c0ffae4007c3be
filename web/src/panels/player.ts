import type { Trajectory } from "../core/trajectory.js";
import { element } from "./element.js";

/** Plays a motion: a time bar, play and pause. */
export class Player {
  readonly root = element("div", { class: "player", hidden: true });
  private readonly bar = element("input", { type: "range", min: 0, step: "any", "aria-label": "Time, seconds" });
  private readonly button = element("button", { type: "button" }, "Play");
  private readonly clock = element("output");
  private motion: Trajectory | null = null;
  private frame: number | null = null;

  constructor(private readonly place: (q: number[], time: number) => void) {
    this.bar.addEventListener("input", () => {
      this.pause();
      this.show();
    });
    this.button.addEventListener("click", () => (this.frame === null ? this.play() : this.pause()));
    this.root.append(this.button, this.bar, this.clock);
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
    const begin = performance.now() - 1000 * Number(this.bar.value);
    this.button.textContent = "Pause";
    const step = (): void => {
      const time = Math.min(end, (performance.now() - begin) / 1000);
      this.bar.value = String(time);
      this.show();
      if (time >= end) this.pause();
      else this.frame = requestAnimationFrame(step);
    };
    this.frame = requestAnimationFrame(step);
  }

  /** Stops and shows a time. */
  seek(time: number): void {
    this.pause();
    this.bar.value = String(time);
    this.show();
  }

  pause(): void {
    if (this.frame !== null) cancelAnimationFrame(this.frame);
    this.frame = null;
    this.button.textContent = "Play";
  }

  private show(): void {
    if (!this.motion) return;
    const time = Number(this.bar.value);
    this.clock.textContent = `${time.toFixed(2)} s`;
    this.place(this.motion.at(time), time);
  }
}
