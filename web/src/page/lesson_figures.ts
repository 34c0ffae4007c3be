import { cartesianRows } from "../core/cartesian.js";
import { poseOfRpy, positionOf, toolPose, toolPosition } from "../core/pose.js";
import { element, shown as text } from "../elements/element.js";
import { slide, slider } from "../panels/slider.js";
import { ControlRuns, type ControlKind } from "./control_runs.js";
import { printedFigure } from "./figure_drawing.js";
import { columns, exponentials, inverseSteps, jacobians, transforms } from "./lesson_numbers.js";
import { through, type LessonPlayer } from "./lesson_player.js";
import { ProofFigure } from "./proof_figure.js";
import type { Services, Shown } from "./section.js";
import { selfMotion } from "./self_motion.js";

/** What a lesson draws at the arm, shows in its text, and plays under the picture. */
export interface LessonFigure {
  readonly root: HTMLElement;
  update(shown: Shown, q: number[]): void;
  leave(): void;
}

const degree = Math.PI / 180;
const rrr = (...degrees: number[]): number[] => degrees.map((value) => value * degree);
const address = (arm: string, q: number[], more = ""): string => `#arm=${arm}&q=${q.join(",")}${more}`;

type Links = [label: string, address: string][];

/** A figure of the chapter: its configurations as links, what is played, and numbers that follow the arm. */
interface Scenes {
  caption: string;
  scenes: Links;
  /** Another figure of the lesson is played. */
  isStill?: boolean;
  /** The arm that motion and numbers are about; without it any. */
  arm?: string;
  /** The numbers can be computed of any planar arm without mimic joints. */
  ofPlanarArms?: boolean;
  /** The configurations that the motion passes; without it each joint moves to and fro. */
  through?: number[][];
  /** The rows of the motion from q, in place of these. */
  rows?(shown: Shown, q: number[]): number[][];
  numbers?(shown: Shown, q: number[]): HTMLElement;
}

/** Each joint in turn, from 0 to and fro. */
function sweep({ description: { joints } }: Shown): number[][] {
  const zero = joints.map(() => 0);
  const ways = joints.flatMap(({ type }, k) => {
    const far = type === "prismatic" ? [0.8] : type === "helical" ? [Math.PI, -Math.PI] : [1.2, -1.2];
    return [...far.map((value) => zero.map((_, i) => (i === k ? value : 0))), zero];
  });
  return [zero, ...ways];
}

/** The self-motion of a redundant arm, there and back: the tool keeps the pose that it has at q. */
function restingTool({ arm }: Shown, q: number[]): number[][] {
  const pose = toolPose(arm, q);
  const rows = [q];
  let before: number[] = [];
  for (let i = 0; i < selfSteps; ++i) {
    const now = rows.at(-1) ?? q;
    const found = selfMotion(arm.jacobian(now, "base"), arm.dof);
    if (!found) return [];
    const along = found.reduce((sum, value, k) => sum + value * (before[k] ?? 0), 0);
    const direction = along < 0 ? found.map((value) => -value) : found; // both are right: the one that goes on
    const moved = now.map((value, k) => value + selfStep * (direction[k] ?? 0));
    const [corrected] = arm.inverse(pose, moved);
    if (!corrected) break;
    before = direction;
    rows.push(Array.from(corrected));
  }
  return [...rows, ...rows.slice(0, -1).reverse()];
}
const selfSteps = 90;
const selfStep = 0.02; // rad

function linksOf(links: Links): HTMLElement[] {
  const all = links.map(([label, href]) => element("a", { class: "scene", href }, label));
  return all.length > 0 ? [element("p", { class: "pair" }, ...all)] : [];
}

class SceneFigure implements LessonFigure {
  readonly root = element("figure", { class: "chapter-figure" });
  private readonly numbers = element("div");
  private arm: Shown["arm"] | null = null;

  constructor(
    private readonly player: LessonPlayer,
    private readonly what: Scenes,
  ) {
    this.root.append(element("figcaption", {}, what.caption), ...linksOf(what.scenes), this.numbers);
  }

  update(shown: Shown, q: number[]): void {
    const { arm, rows, numbers, ofPlanarArms = false } = this.what;
    const isAbout = arm === undefined || arm === shown.description.name;
    const hasOwnJoints = shown.arm.links === q.length + 1; // no joint follows another
    const fits = isAbout || (ofPlanarArms && shown.arm.planar && hasOwnJoints);
    if (shown.arm !== this.arm && !this.what.isStill) {
      this.arm = shown.arm;
      if (isAbout) this.player.take(rows?.(shown, q) ?? through(this.what.through ?? sweep(shown)));
      else this.player.take(fits ? through(sweep(shown)) : []);
    }
    if (!numbers) return;
    const kind = ofPlanarArms ? "planar arms without mimic joints" : `the arm ${arm}`;
    const instead = (): HTMLElement => element("p", { class: "quiet" }, `The numbers here are only of ${kind}.`);
    this.numbers.replaceChildren(fits ? numbers(shown, q) : instead());
  }

  leave(): void {
    this.arm = null;
    if (!this.what.isStill) this.player.take([]);
  }
}

/** What both figures of control share: the gain, and a start that stays while the motion is played. */
abstract class GainFigure implements LessonFigure {
  readonly root = element("fieldset", { class: "gains chapter-figure" });
  private readonly gain = slider({ id: "lesson-gain", min: 0.02, max: 2.5, step: 0.01 });
  private readonly value = element("output", { for: "lesson-gain" });
  protected readonly says = element("p", { role: "status" });
  private drawn = "";
  /** Where the motion starts, and the joint values that the player has set last: a hand has not moved the arm since. */
  private start: number[] | null = null;
  private placed: number[] | null = null;

  constructor(
    protected readonly services: Services,
    protected readonly player: LessonPlayer,
    caption: string,
    start: Links,
    ...content: HTMLElement[]
  ) {
    this.gain.addEventListener("input", () => services.store.set({ gain: Number(this.gain.value) }));
    const label = element("label", { for: "lesson-gain" }, "Gain Kp");
    const row = element("div", { class: "joint" }, label, this.gain, this.value);
    this.root.append(element("legend", {}, caption), row, ...linksOf(start), ...content, this.says);
  }

  /** Draws the trails and gives the player its rows. */
  protected abstract draw(shown: Shown, q: number[]): void;

  update(shown: Shown, q: number[]): void {
    const { goal, gain } = this.services.store.get();
    slide(this.gain, gain);
    this.value.textContent = gain.toFixed(2);
    if (this.player.places) this.placed = q;
    if (this.start === null || q.some((value, k) => value !== this.placed?.[k])) this.start = q;
    const key = JSON.stringify([shown.description.name, this.start, goal, gain]);
    if (this.player.places || key === this.drawn) return;
    this.drawn = key;
    this.says.textContent = "";
    try {
      this.draw(shown, this.start);
    } catch (error) {
      this.player.take([]);
      this.says.textContent = (error as Error).message;
    }
  }

  leave(): void {
    this.drawn = "";
    this.start = this.placed = null;
    this.player.take([]);
    this.services.draw({ trails: [], ghosts: [], waypoints: [] });
  }
}

const stepsPerSecond = 12;
const equations: Record<ControlKind, string> = { joint: "eq. 1.3", cartesian: "eq. 1.6" };

/** The paths of the tool under control in joint space and in Cartesian space: Figure 1.7. They follow the gain, and the
 * arm while a hand moves it. */
class ControlFigure extends GainFigure {
  private readonly runs: ControlRuns;

  constructor(
    services: Services,
    player: LessonPlayer,
    private readonly kinds: ControlKind[],
    caption: string,
    start: Links,
  ) {
    const runs = new ControlRuns(services, kinds);
    super(services, player, caption, start, runs.root);
    this.runs = runs;
  }

  protected draw(shown: Shown, q: number[]): void {
    const { goal, gain } = this.services.store.get();
    if (goal === null || goal.length !== shown.arm.dof) {
      this.player.take([]);
      this.services.draw({ trails: [], ghosts: [] });
      throw new Error("There is no goal: choose the lesson in the contents again, which sets its arm and goal.");
    }
    const trails = this.runs.update(shown, { from: q, goal, gains: { kp: gain, ki: 0, kd: 0 } });
    this.services.draw({ trails, ghosts: [{ q: goal, tone: "goal" }] });
    const all = this.kinds.map((kind) => this.runs.rowsOf(kind));
    const parts = all.map((rows, i) => ({ name: equations[this.kinds[i] ?? "joint"], rows: rows.length }));
    this.player.take(all.flat(), stepsPerSecond, parts.length > 1 ? parts : []);
  }

  override leave(): void {
    this.runs.stop();
    super.leave();
  }
}

const waypoints = [
  [6, 2.5, 30],
  [-0.5, 6.5, 120],
  [-4, 2.5, 180],
].map(([x = 0, y = 0, angle = 0]) => poseOfRpy([x, y, 0, 0, 0, angle * degree]));

const dotsFrom = 0.1; // the gain from which each step has a dot

/** The distance of a point in the plane from the nearest of the straight lines through poses. */
function awayFrom(line: number[][], [x = 0, y = 0]: number[]): number {
  const distances = line.slice(1).map(([bx = 0, by = 0], i) => {
    const [ax = 0, ay = 0] = line[i] ?? [];
    const [dx, dy] = [bx - ax, by - ay];
    const part = Math.min(1, Math.max(0, ((x - ax) * dx + (y - ay) * dy) / (dx * dx + dy * dy || 1)));
    return Math.hypot(x - ax - part * dx, y - ay - part * dy);
  });
  return Math.min(...distances);
}

/** Cartesian control through three waypoints: Figure 1.9. */
class WaypointsFigure extends GainFigure {
  protected draw(shown: Shown, q: number[]): void {
    const { arm, description } = shown;
    if (!arm.planar || arm.dof !== 3) throw new Error("This figure needs the arm rrr.");
    const { gain } = this.services.store.get();
    const options = { gain, tolerance: 2e-3, maxSteps: 4000 };
    const rows = [q, ...cartesianRows(arm, description.joints, q, waypoints, options)];
    const points = rows.map((row) => toolPosition(arm, row));
    const every = Math.max(1, Math.round(dotsFrom / gain)); // of a small gain the dots would be one line
    this.services.draw({
      trails: [{ tone: "cartesian", points, dots: true, every }],
      waypoints: waypoints.map((pose, i) => ({ pose, label: String(i + 1), held: false })),
    });
    this.player.take(rows, 3 * stepsPerSecond * every);
    const off = Math.max(...points.map((point) => awayFrom([points[0] ?? [], ...waypoints.map(positionOf)], point)));
    const dots = every === 1 ? "" : ` A dot is ${every} steps.`;
    this.says.textContent = `${rows.length - 1} steps. The tool leaves the straight lines by up to ${text(1000 * off, 0)} mm.${dots}`;
  }
}

const twoLinks = "RR:3.5,2.5";
const [left, right] = [rrr(0, 90, 0), rrr(161, -109, 38)];
const [a, b] = [rrr(112, -52, -60), rrr(60, -45, -90)];
const goal = rrr(99.2, -68.8, -30.4);
const bent = [-0.5, 0.9, -0.4]; // rest is singular
const actuated = rrr(0, 50, -80);

/** The figures of scenes by the names that the lessons use. */
const scenes: Record<string, Scenes> = {
  "1.1": {
    caption: "Figure 1.1: the two main types of joints",
    scenes: [
      ["(a) revolute", "#arm=R:1&q=0.5"],
      ["(b) prismatic", "#arm=P:1&q=0.4"],
    ],
  },
  "1.2": {
    isStill: true,
    caption: "Figure 1.2: other types of joints",
    scenes: [
      ["Spherical (S)", "#arm=S"],
      ["Cylindrical (C)", "#arm=C"],
      ["Helical (H)", "#arm=H"],
      ["Planar (E)", "#arm=E"],
    ],
  },
  "1.3": {
    arm: "rrr",
    caption: "Figure 1.3: the arm RRR with its four frames",
    scenes: [
      ["at rest", address("rrr", rrr(0, 0, 0), "&frames=1")],
      ["θ₂ and θ₃ actuated", address("rrr", actuated, "&frames=1")],
    ],
    through: [rrr(0, 0, 0), rrr(0, 50, 0), actuated],
  },
  "1.4": {
    arm: twoLinks,
    caption: "Figure 1.4: the transforms of a two-link arm",
    scenes: [["as in the figure", address(twoLinks, rrr(50, -65), "&frames=1")]],
    through: [rrr(0, 0), rrr(50, 0), rrr(50, -65)],
    numbers: transforms,
    ofPlanarArms: true,
  },
  "1.5": {
    arm: twoLinks,
    caption: "Figure 1.5: link frames of a two-link arm, a₁ = 3.5 and a₂ = 2.5",
    scenes: [["as in the figure", address(twoLinks, rrr(35, 40), "&frames=1&angles=1")]],
    through: [rrr(0, 0), rrr(35, 0), rrr(35, 40)],
  },
  "1.6": {
    arm: "rrr",
    caption: "Figure 1.6: two configurations of the arm RRR",
    scenes: [
      ["(a) θ = (112°, −52°, −60°)", address("rrr", a)],
      ["(b) θ = (60°, −45°, −90°)", address("rrr", b)],
    ],
    through: [a, b],
    numbers: transforms,
    ofPlanarArms: true,
  },
  "1.8": {
    arm: "rrr",
    caption: "Figure 1.8: the columns of the Jacobian as velocities",
    scenes: [
      ["left: θ = (0°, 90°, 0°)", address("rrr", left, "&columns=1")],
      ["right: θ = (161°, −109°, 38°)", address("rrr", right, "&columns=1")],
    ],
    through: [left, right],
    numbers: columns,
    ofPlanarArms: true,
  },
  exponentials: {
    arm: "rrr",
    caption: "The exponentials follow the arm",
    scenes: [["at rest", address("rrr", rrr(0, 0, 0))]],
    through: [rrr(0, 0, 0), rrr(0, 0, -60), rrr(0, -52, -60), rrr(112, -52, -60)],
    numbers: exponentials,
  },
  jacobians: {
    arm: "rrr",
    caption: "Three Jacobians of one arm",
    scenes: [],
    through: [left, right],
    numbers: jacobians,
    ofPlanarArms: true,
  },
  "self-motion": { caption: "The tool rests while the joints move", scenes: [], rows: restingTool },
  inverse: {
    arm: "rrr",
    caption: "The steps for the pose that the tool has",
    scenes: [],
    through: [a, b],
    numbers: inverseSteps,
  },
};

const again = (q: number[]): Links => [["from the start again", address("rrr", q, `&goal=${goal.join(",")}`)]];

/** The figures of controllers by the names that the lessons use. */
const controllers: Record<string, (services: Services, player: LessonPlayer) => LessonFigure> = {
  "1.7": (services, player) =>
    new ControlFigure(services, player, ["joint"], "Figure 1.7: joint-space control from rest", again(rrr(0, 0, 0))),
  "cartesian-control": (services, player) =>
    new ControlFigure(services, player, ["cartesian"], "Cartesian control to the same goal", again(bent)),
  "both-controls": (services, player) =>
    new ControlFigure(services, player, ["joint", "cartesian"], "Both controllers, eq. 1.3 and 1.6", again(bent)),
  "1.9": (services, player) =>
    new WaypointsFigure(services, player, "Figure 1.9: straight paths through three waypoints", again(left)),
  proof: (services, player) => new ProofFigure(services, player, [a, b]),
};

/** The names of all figures. */
export const figureNames = [...Object.keys(scenes), ...Object.keys(controllers)];

/** Makes a figure by the name that a lesson uses; null: there is none. */
export function lessonFigure(name: string, services: Services, player: LessonPlayer): LessonFigure | null {
  const found = scenes[name];
  const made = found ? new SceneFigure(player, found) : (controllers[name]?.(services, player) ?? null);
  if (/^\d\.\d$/.test(name)) made?.root.append(printedFigure(services, name)); // of the chapter
  return made;
}
