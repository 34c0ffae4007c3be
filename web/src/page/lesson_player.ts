import { iconButton } from "../elements/button.js";
import { element } from "../elements/element.js";
import { icon } from "../elements/icons.js";
import { slide, slider } from "../panels/slider.js";

const speeds = [0.25, 0.5, 1, 2, 4];
const names = ["¼×", "½×", "1×", "2×", "4×"];

/** One of several motions that are played one after the other: its name, and how many rows it has. */
export interface PlayedPart {
  name: string;
  rows: number;
}

/** Plays the motion of a lesson's figure, row by row, under the picture: play, one step, speed, and a bar of steps. */
export class LessonPlayer {
  readonly root = element("div", {
    class: "player lesson-player",
    role: "group",
    "aria-label": "Motion",
    hidden: true,
  });
  /** The player moves the arm at the moment: it was no hand. */
  places = false;
  private readonly word = element("span", {}, "Play");
  private readonly button = element("button", { type: "button", class: "icon-button" }, icon("play"), this.word);
  private readonly bar = slider({ min: 0, max: 1, step: 1, value: 0, "aria-label": "Step" });
  private readonly speed = element("select", { "aria-label": "Speed" });
  private readonly count = element("output", { "aria-live": "off" });
  private rows: number[][] = [];
  private perSecond = 30;
  private parts: PlayedPart[] = [];
  private frame: number | null = null;

  constructor(private readonly place: (q: number[]) => void) {
    this.speed.append(...speeds.map((value, i) => element("option", { value }, names[i] ?? "")));
    this.speed.value = "1";
    this.button.addEventListener("click", () => (this.frame === null ? this.play() : this.pause()));
    this.bar.addEventListener("input", () => {
      this.pause();
      this.show(Number(this.bar.value));
    });
    const step = iconButton("step", "Step", "One step on", () => {
      this.pause();
      this.show(this.at < this.rows.length - 1 ? this.at + 1 : 0);
    });
    this.root.append(this.button, step, this.bar, this.count, this.speed);
  }

  /** The index of the row that the bar shows. */
  private get at(): number {
    return Number(this.bar.value);
  }

  /** Takes the joint values of a motion, a row a step; fewer than two: there is none. Steps are counted in each part. */
  take(rows: number[][], perSecond = 30, parts: PlayedPart[] = []): void {
    this.pause();
    this.rows = rows;
    this.parts = parts;
    this.perSecond = perSecond;
    this.root.hidden = rows.length < 2;
    this.bar.max = String(Math.max(1, rows.length - 1));
    slide(this.bar, 0);
    this.say();
  }

  pause(): void {
    if (this.frame !== null) cancelAnimationFrame(this.frame);
    this.frame = null;
    this.mark("Play");
  }

  private play(): void {
    const last = this.rows.length - 1;
    if (this.at >= last) this.show(0);
    let exact = this.at;
    let before = performance.now();
    const go = (now: number): void => {
      exact = Math.min(last, exact + (Math.max(0, now - before) / 1000) * this.perSecond * Number(this.speed.value));
      before = now;
      this.show(Math.floor(exact));
      if (exact >= last) this.pause();
      else this.frame = requestAnimationFrame(go);
    };
    this.mark("Pause");
    this.frame = requestAnimationFrame(go);
  }

  private show(index: number): void {
    const row = this.rows[index];
    if (!row) return;
    slide(this.bar, index);
    this.say();
    this.places = true;
    this.place(row);
    this.places = false;
  }

  private mark(word: "Play" | "Pause"): void {
    if (this.word.textContent === word) return;
    this.word.textContent = word;
    this.button.replaceChild(icon(word === "Play" ? "play" : "pause"), this.button.firstChild as Node);
  }

  private say(): void {
    let at = this.at;
    for (const { name, rows } of this.parts) {
      this.count.textContent = `${name}: ${at} / ${rows - 1}`;
      if (at < rows) return;
      at -= rows;
    }
    this.count.textContent = `${this.at} / ${this.rows.length - 1}`;
  }
}

const legRows = 45;

/** The way through configurations, each leg from rest to rest. */
export function through(configurations: number[][]): number[][] {
  const rows = configurations.slice(0, 1);
  for (const [i, from] of configurations.slice(0, -1).entries()) {
    const to = configurations[i + 1] ?? from;
    for (let k = 1; k <= legRows; ++k) {
      const part = (1 - Math.cos((Math.PI * k) / legRows)) / 2;
      rows.push(from.map((value, j) => value + part * ((to[j] ?? value) - value)));
    }
  }
  return rows;
}
