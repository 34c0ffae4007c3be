import { element } from "../elements/element.js";

/** Joint values at a time since the recording began, seconds. */
export interface Recorded {
  time: number;
  q: number[];
}

const most = 100_000; // samples: half an hour of a hand
const shortest = 1e-3; // seconds between samples

/** Records the joint values as they change: by sliders, the hand at the tool, or a program. */
export class Recorder {
  /** Begins and ends. */
  readonly button = element("button", { type: "button", "aria-pressed": "false" }, "Record");
  /** Says, beside the picture, that a recording runs; a click ends it. */
  readonly light = element("button", { type: "button", class: "light", hidden: true }, "● Recording: stop");
  private samples: Recorded[] | null = null;
  private begin = 0;

  constructor(
    private readonly now: () => number[] | null,
    private readonly done: (samples: Recorded[]) => void,
  ) {
    this.button.addEventListener("click", () => (this.samples ? this.stop() : this.start()));
    this.light.addEventListener("click", () => this.stop());
  }

  /** Takes joint values if a recording runs. */
  take(q: number[]): void {
    const { samples } = this;
    if (!samples) return;
    const time = (performance.now() - this.begin) / 1000;
    const last = samples.at(-1);
    if (last && time - last.time < shortest) last.q = q;
    else samples.push({ time, q });
    if (samples.length >= most) this.stop();
  }

  /** Ends without a result. */
  drop(): void {
    this.samples = null;
    this.show();
  }

  private start(): void {
    const q = this.now();
    if (!q) return;
    this.begin = performance.now();
    this.samples = [{ time: 0, q }];
    this.show();
  }

  private stop(): void {
    const q = this.now();
    if (q) this.take(q); // where the arm rests in the end
    const { samples } = this;
    this.drop();
    if (samples && samples.length > 1) this.done(samples);
  }

  private show(): void {
    const running = this.samples !== null;
    this.light.hidden = !running;
    this.button.textContent = running ? "Stop" : "Record";
    this.button.setAttribute("aria-pressed", String(running));
  }
}
