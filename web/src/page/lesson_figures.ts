import { element, shown as text } from "../elements/element.js";
import { slide, slider } from "../panels/slider.js";
import { jointColour } from "../scene/colours.js";
import { ControlRuns, type ControlKind } from "./control_runs.js";
import type { Services, Shown } from "./section.js";

/** What a lesson draws at the arm, and shows in its text. */
export interface LessonFigure {
  readonly root: HTMLElement;
  update(shown: Shown, q: number[]): void;
  leave(): void;
}

/** The columns of the Jacobian as numbers, beside the arrows at the tool: Figure 1.8. */
class JacobianFigure implements LessonFigure {
  readonly root = element("ul", { class: "columns" });

  update({ arm }: Shown, q: number[]): void {
    const all = arm.jacobian(q);
    const rows = arm.planar ? [0, 1] : [0, 1, 2];
    this.root.replaceChildren(
      ...q.map((_, k) => {
        const swatch = element("span", {
          class: "swatch",
          "aria-hidden": "true",
          style: `background: ${jointColour(k)}`,
        });
        const column = rows.map((i) => text(all[6 * k + i] ?? 0, 2)).join(", ");
        return element("li", {}, swatch, `joint ${k + 1}: (${column}) m/s`);
      }),
    );
  }

  leave(): void {
    this.root.replaceChildren();
  }
}

/** The paths of the tool under control in joint space and in Cartesian space: Figures 1.7 and 1.9. They follow the gain,
 * and the arm while it is moved. */
class ControlFigure implements LessonFigure {
  readonly root = element("fieldset", { class: "gains" }, element("legend", {}, "Try it"));
  private readonly gain = slider({ id: "lesson-gain", min: 0.02, max: 2.5, step: 0.01 });
  private readonly value = element("output", { for: "lesson-gain" });
  private readonly says = element("p", { role: "status" });
  private readonly runs: ControlRuns;
  private drawn = "";

  constructor(
    private readonly services: Services,
    kinds: ControlKind[],
  ) {
    this.runs = new ControlRuns(services, kinds);
    this.gain.addEventListener("input", () => services.store.set({ gain: Number(this.gain.value) }));
    const label = element("label", { for: "lesson-gain" }, "Gain Kp");
    this.root.append(element("div", { class: "joint" }, label, this.gain, this.value), this.runs.root, this.says);
  }

  update(shown: Shown, q: number[]): void {
    const { goal, gain } = this.services.store.get();
    slide(this.gain, gain);
    this.value.textContent = gain.toFixed(2);
    const key = JSON.stringify([shown.description.name, q, goal, gain]);
    if (key === this.drawn) return;
    this.drawn = key;
    this.says.textContent = "";
    if (goal === null || goal.length !== shown.arm.dof) {
      this.says.textContent = "There is no goal yet: choose the lesson in the list again, which sets its arm and goal.";
      return this.services.draw({ trails: [], ghosts: [] });
    }
    try {
      const trails = this.runs.update(shown, { from: q, goal, gains: { kp: gain, ki: 0, kd: 0 } });
      this.services.draw({ trails, ghosts: [{ q: goal, tone: "goal" }] });
    } catch (error) {
      this.says.textContent = (error as Error).message;
    }
  }

  leave(): void {
    this.runs.stop();
    this.drawn = "";
    this.services.draw({ trails: [], ghosts: [] });
  }
}

/** The figures by the names that the lessons use. */
export const lessonFigures: Record<string, (services: Services) => LessonFigure> = {
  jacobian: () => new JacobianFigure(),
  "joint-control": (services) => new ControlFigure(services, ["joint"]),
  "cartesian-control": (services) => new ControlFigure(services, ["cartesian"]),
  "both-controls": (services) => new ControlFigure(services, ["joint", "cartesian"]),
};
