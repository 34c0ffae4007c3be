import rows from "virtual:opening";
import { toolPosition } from "../core/pose.js";
import { reducedMotion } from "../elements/motion.js";
import type { Mark, Trail } from "../scene/picture.js";
import { poses } from "./opening_rows.js";
import type { Services, Shown } from "./section.js";

const dots = 200;
const duration = 4500; // milliseconds
export const invitation = "Drag the tool.";

/** The page begins with an arm that draws the three lines of Figure 1.9, and hands over. */
export class Opening {
  private running = true;
  private isOver = false;
  private readonly events = ["pointerdown", "keydown", "wheel"] as const;

  constructor(
    private readonly services: Services,
    private readonly shown: Shown,
    private readonly ended: () => void,
  ) {
    for (const name of this.events) document.addEventListener(name, this.stop, { capture: true, passive: true });
    void this.run();
  }

  private async run(): Promise<void> {
    const marks: Mark[] = poses.map((pose, i) => ({ pose, label: String(i + 1), held: false }));
    this.services.store.set({ showAngles: false }); // as in the figure
    const extent = rows
      .filter((_, i) => i % 10 === 0)
      .flatMap((q) => this.shown.arm.skeleton(q).joints.map(({ centre }) => centre));
    this.services.draw({ waypoints: marks, extent });
    const every = (rows.length - 1) / (dots - 1);
    const points = Array.from({ length: dots }, (_, i) =>
      toolPosition(this.shown.arm, rows[Math.round(i * every)] ?? []),
    );
    const begin = performance.now();
    while (this.running) {
      const fraction = reducedMotion() ? 1 : Math.min(1, (performance.now() - begin) / duration);
      const index = Math.round(fraction * (rows.length - 1));
      const trail: Trail = { tone: "planned", points: points.slice(0, Math.floor(index / every) + 1), dots: true };
      this.services.draw({ trails: [trail] });
      this.services.store.set({ q: rows[index] ?? null });
      if (fraction === 1) break;
      await new Promise((resolve) => requestAnimationFrame(resolve));
    }
    if (!this.running) return;
    this.handOver();
    this.shown.picture.say(invitation, "hint");
    const { store } = this.services;
    const end = store.subscribe((_, changed) => {
      if (!changed.has("q") && !changed.has("section")) return;
      this.shown.picture.say(""); // the arm moves, or something else is looked at
      end();
    });
  }

  /** A hand has come: the arm stays where it is, and the figure disappears. */
  private readonly stop = (): void => {
    for (const name of this.events) document.removeEventListener(name, this.stop, { capture: true });
    this.running = false;
    this.services.draw({ trails: [], waypoints: [], extent: [] });
    this.shown.picture.say("");
    this.handOver();
  };

  private handOver(): void {
    if (this.isOver) return;
    this.isOver = true;
    this.services.store.set({ showAngles: true });
    this.ended();
  }
}
