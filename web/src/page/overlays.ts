import { toolPose } from "../core/pose.js";
import { withPresent } from "../panels/solutions.js";
import { noSectionMarks, type Ghost } from "../scene/picture.js";
import type { PageState } from "../state/page_state.js";
import { Rest } from "./rest.js";
import type { SectionMarks, Shown } from "./section.js";

const quick = 6; // milliseconds of inverse kinematics in one picture
const drawnAtOnce = 5; // solutions that are drawn at once: more hide each other

/** What is drawn beside the arm in all sections: frames, angles, other solutions, columns of the Jacobian and its
 * ellipsoid, and the marks of the section. */
export class Overlays {
  private shown: Shown | null = null;
  private section: SectionMarks = {};
  private solutions: number[][] = [];
  /** Joint values that the hand wants and an obstacle keeps the arm from. */
  private wanted: number[] | null = null;
  private isQuick = true;
  private readonly rest = new Rest();

  take(shown: Shown): void {
    this.shown = shown;
    this.isQuick = true;
    this.solutions = [];
    this.wanted = null;
    this.section = {};
  }

  /** Draws what belongs to joint values. */
  update(q: number[], state: Readonly<PageState>): void {
    if (!this.shown) return;
    const { arm, picture } = this.shown;
    picture.show(q, arm.forward(q));
    const wanted = state.showColumns || state.showEllipsoid;
    const jacobian = wanted ? arm.jacobian(q, "base") : null;
    const columns = jacobian && q.map((_, k) => Array.from(jacobian.subarray(6 * k, 6 * k + 6)));
    this.find(q, state.showSolutions);
    picture.mark({
      frames: state.showFrames,
      angles: state.showAngles,
      degrees: state.degrees,
      columns: state.showColumns ? columns : null,
      ellipsoid: state.showEllipsoid ? columns : null,
      ghosts: this.ghosts(),
    });
  }

  /** Draws the marks of a section; those that are not named stay. */
  draw(marks: SectionMarks): void {
    this.section = { ...this.section, ...marks };
    this.shown?.picture.mark({ ...marks, ghosts: this.ghosts() });
  }

  /** Shows joint values that the arm is kept from; null: none. */
  want(q: number[] | null): void {
    this.wanted = q;
    this.shown?.picture.mark({ ghosts: this.ghosts() });
  }

  /** Another section begins without marks. */
  clear(): void {
    this.section = {};
    this.shown?.picture.mark({ ...noSectionMarks, ghosts: this.ghosts() });
  }

  /** Shows one of the solutions alone, or all again; the present one, index 0, has no ghost. */
  point(solution: number[] | null, all: boolean): void {
    if (!all) {
      const ghosts: Ghost[] = solution ? [{ q: solution, tone: "solution" }] : [];
      this.shown?.picture.mark({ ghosts: [...(this.section.ghosts ?? []), ...ghosts] });
      return;
    }
    const ghosts = this.ghosts();
    if (!solution) return this.shown?.picture.mark({ ghosts, pointed: null });
    const index = ghosts.findIndex(({ q }) => solution.every((value, k) => Math.abs(value - (q[k] ?? NaN)) < 1e-6));
    if (index < 0) ghosts.unshift({ q: solution, tone: "solution" });
    this.shown?.picture.mark({ ghosts, pointed: Math.max(0, index) });
  }

  private ghosts(): Ghost[] {
    const others = this.solutions.map((q): Ghost => ({ q, tone: "solution" }));
    const wanted: Ghost[] = this.wanted ? [{ q: this.wanted, tone: "goal" }] : [];
    return [...wanted, ...(this.section.ghosts ?? []), ...others];
  }

  /** Finds the other solutions for the tool's pose: all of them where that is quick or the arm rests; in motion the
   * known ones follow the tool. */
  private find(q: number[], wanted: boolean): void {
    this.rest.cancel();
    if (!wanted || !this.shown) {
      this.solutions = [];
      return;
    }
    const { arm } = this.shown;
    const pose = toolPose(arm, q);
    if (this.isQuick) {
      const begin = performance.now();
      this.solutions = this.others(q, arm.inverse(pose, q, { all: true }));
      this.isQuick = performance.now() - begin < quick;
      return;
    }
    this.solutions = this.others(
      q,
      this.solutions.flatMap((one) => arm.inverse(pose, one).slice(0, 1)),
    );
    const { shown } = this;
    this.rest.then(() => {
      if (shown !== this.shown) return;
      this.solutions = this.others(q, arm.inverse(pose, q, { all: true }));
      shown.picture.mark({ ghosts: this.ghosts() });
    });
  }

  /** The solutions besides the present one that look most different from it and from each other. */
  private others(q: number[], found: Float64Array[]): number[][] {
    const all = withPresent(
      found.map((one) => Array.from(one)),
      q,
    );
    if (all.length <= drawnAtOnce + 1) return all.slice(1);
    return mostDifferent(
      all,
      (values) => this.shown?.arm.skeleton(values).joints.flatMap(({ centre }) => centre) ?? [],
    );
  }
}

/** Of the configurations behind the first one those that are farthest from it and from each other, chosen one by one.
 * `places`: where the joints are, m. */
function mostDifferent(all: number[][], places: (q: number[]) => number[]): number[][] {
  const seen = all.map(places);
  const distance = (a: number, b: number): number =>
    Math.hypot(...(seen[a] ?? []).map((value, i) => value - (seen[b]?.[i] ?? 0)));
  const nearest = all.map((_, i) => distance(i, 0));
  const chosen: number[] = [];
  while (chosen.length < drawnAtOnce) {
    const next = nearest.indexOf(Math.max(...nearest));
    chosen.push(next);
    nearest.forEach((far, i) => (nearest[i] = Math.min(far, distance(i, next))));
  }
  return chosen.map((i) => all[i] ?? []);
}
