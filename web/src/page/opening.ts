import { cartesianRows } from "../core/cartesian.js";
import { poseOfRpy, toolPosition } from "../core/pose.js";
import { reducedMotion } from "../elements/motion.js";
import type { Mark, Trail } from "../scene/picture.js";
import type { Services, Shown } from "./section.js";

/** Figure 1.9 of the chapter: eq. 1.6 from this start through three poses, x, y, degrees. */
const start = [0, Math.PI / 2, 0];
const waypoints = [
  [6, 2.5, 30],
  [-0.5, 6.5, 120],
  [-4, 2.5, 180],
] as const;
const control = { gain: 0.01, tolerance: 2e-3, maxSteps: 20_000 };
const dots = 200;
const duration = 4500; // milliseconds
export const invitation = "Drag the tool.";

const poses = waypoints.map(([x, y, degrees]) => poseOfRpy([x, y, 0, 0, 0, (degrees * Math.PI) / 180]));

/** The joint values of the figure, one row a step; the last one at the last pose, which control only comes near. */
export function openingRows({ arm, description }: Pick<Shown, "arm" | "description">): number[][] {
  const rows = [start, ...cartesianRows(arm, description.joints, start, poses, control)];
  const [exact] = arm.inverse(poses.at(-1) ?? [], rows.at(-1) ?? start);
  return exact ? [...rows, Array.from(exact)] : rows;
}

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
    void this.run(openingRows(shown));
  }

  private async run(rows: number[][]): Promise<void> {
    const marks: Mark[] = poses.map((pose, i) => ({ pose, label: String(i + 1), held: false }));
    this.services.store.set({ showAngles: false }); // as in the figure
    const extent = rows
      .filter((_, i) => i % 50 === 0)
      .flatMap((q) => this.shown.arm.skeleton(q).joints.map(({ centre }) => centre));
    this.services.draw({ waypoints: marks, extent });
    const every = (rows.length - 1) / (dots - 1);
    const points = Array.from({ length: dots }, (_, i) =>
      toolPosition(this.shown.arm, rows[Math.round(i * every)] ?? start),
    );
    const begin = performance.now();
    while (this.running) {
      const fraction = reducedMotion() ? 1 : Math.min(1, (performance.now() - begin) / duration);
      const index = Math.round(fraction * (rows.length - 1));
      const trail: Trail = { tone: "planned", points: points.slice(0, Math.floor(index / every) + 1), dots: true };
      this.services.draw({ trails: [trail] });
      this.services.store.set({ q: rows[index] ?? start });
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
