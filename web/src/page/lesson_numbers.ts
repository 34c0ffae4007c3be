import { headingOf } from "../core/pose.js";
import { element, shown as text } from "../elements/element.js";
import { jointColour } from "../scene/colours.js";
import type { Shown } from "./section.js";

const degree = Math.PI / 180;
type Rows = number[][];

/** A matrix as MathML. */
function matrix(rows: Rows): string {
  const cells = rows.map((row) => `<mtr>${row.map((value) => `<mtd><mn>${text(value, 2)}</mn></mtd>`).join("")}</mtr>`);
  return `<mrow><mo>(</mo><mtable>${cells.join("")}</mtable><mo>)</mo></mrow>`;
}

/** Equations with a matrix each, below each other: the left sides are MathML of ours. */
function equations(all: [left: string, rows: Rows][]): HTMLElement {
  const root = element("div", { class: "matrices", role: "group", "aria-label": "Matrices", tabindex: 0 }); // keys scroll it
  root.innerHTML = all
    .map(([left, rows]) => `<math display="block"><mrow>${left}<mo>=</mo>${matrix(rows)}</mrow></math>`)
    .join("");
  return root;
}

const indexed = (letter: string, below: string, above: string): string =>
  `<msubsup><mi>${letter}</mi><mn>${below}</mn><mn>${above}</mn></msubsup>`;

function product(a: Rows, b: Rows): Rows {
  return a.map((row) => (b[0] ?? []).map((_, k) => row.reduce((sum, value, i) => sum + value * (b[i]?.[k] ?? 0), 0)));
}

/** The matrix of a planar pose. */
function planar(angle: number, x: number, y: number): Rows {
  const [c, s] = [Math.cos(angle), Math.sin(angle)];
  return [
    [c, -s, x],
    [s, c, y],
    [0, 0, 1],
  ];
}

const rowsOf = (pose: ArrayLike<number>): Rows => planar(headingOf(pose), pose[12] ?? 0, pose[13] ?? 0);

/** The pose of a link's frame in the frame of the link before, both planar. */
function between(before: ArrayLike<number>, after: ArrayLike<number>): Rows {
  const angle = headingOf(before);
  const [c, s] = [Math.cos(angle), Math.sin(angle)];
  const [dx, dy] = [12, 13].map((i) => (after[i] ?? 0) - (before[i] ?? 0)) as [number, number];
  return planar(headingOf(after) - angle, c * dx + s * dy, c * dy - s * dx);
}

/** The link transforms of a planar arm and their product, the pose of the last link, eq. 1.1: Figure 1.4. */
export function transforms({ arm }: Shown, q: number[]): HTMLElement {
  const frames = arm.forward(q);
  const links = q.map((_, k): [string, Rows] => {
    return [indexed("T", String(k + 1), String(k)), between(frames[k] ?? [], frames[k + 1] ?? [])];
  });
  const names = links.map(([name]) => name).join("");
  const last = links.map(([, rows]) => rows).reduce(product, planar(0, 0, 0));
  return equations([...links, [`${indexed("T", String(q.length), "0")}<mo>=</mo>${names}`, last]]);
}

/** The exponentials of the joints' screws at rest and the rest pose M: T = e^[S1]θ1 … e^[Sn]θn M. */
export function exponentials({ arm }: Shown, q: number[]): HTMLElement {
  const zero = q.map(() => 0);
  const rest = rowsOf(arm.forward(zero).at(-1) ?? []);
  const factors = arm.skeleton(zero).joints.map(({ centre: [x = 0, y = 0] }, k): [string, Rows] => {
    const angle = q[k] ?? 0;
    const [c, s] = [Math.cos(angle), Math.sin(angle)];
    const power = `<mrow><mo>[</mo><msub><mi>S</mi><mn>${k + 1}</mn></msub><mo>]</mo><msub><mi>θ</mi><mn>${k + 1}</mn></msub></mrow>`;
    return [`<msup><mi>e</mi>${power}</msup>`, planar(angle, x - c * x + s * y, y - s * x - c * y)];
  });
  const names = factors.map(([name]) => name).join("");
  const tool = [...factors.map(([, rows]) => rows), rest].reduce(product, planar(0, 0, 0));
  return equations([...factors, ["<mi>M</mi>", rest], [`<mi>T</mi><mo>=</mo>${names}<mi>M</mi>`, tool]]);
}

/** The Jacobian of a planar arm in three frames, rows x, y, θ. */
export function jacobians({ arm }: Shown, q: number[]): HTMLElement {
  const rows = (frame: "base" | "space" | "tool"): Rows => {
    const all = arm.jacobian(q, frame);
    return [0, 1, 5].map((i) => q.map((_, k) => all[6 * k + i] ?? 0));
  };
  const name = (below: string): string => `<msub><mi>J</mi><mtext>${below}</mtext></msub>`;
  return equations([
    ["<mi>J</mi>", rows("base")],
    [name("space"), rows("space")],
    [name("body"), rows("tool")],
  ]);
}

/** The columns of a planar arm's Jacobian, their x and y as numbers, beside the arrows at the tool: Figure 1.8. */
export function columns({ arm }: Shown, q: number[]): HTMLElement {
  const all = arm.jacobian(q);
  const items = q.map((_, k) => {
    const style = `background: ${jointColour(k)}`;
    const swatch = element("span", { class: "swatch", "aria-hidden": "true", style });
    const column = [0, 1].map((i) => text(all[6 * k + i] ?? 0, 2)).join(", ");
    return element("li", {}, swatch, `joint ${k + 1}: (${column}) m/s`);
  });
  return element("ul", { class: "columns" }, ...items);
}

/** Inverse kinematics of the arm RRR, step by step, for the pose that the tool has: (l1, l2, l3) are its links. */
export function inverseSteps({ arm }: Shown, q: number[]): HTMLElement {
  const [l1, l2, l3] = [3.5, 3.5, 2];
  const tool = arm.forward(q).at(-1) ?? [];
  const [x, y, angle] = [tool[12] ?? 0, tool[13] ?? 0, headingOf(tool)];
  const [wx, wy] = [x - l3 * Math.cos(angle), y - l3 * Math.sin(angle)];
  const square = wx * wx + wy * wy;
  const cosine = (square - l1 * l1 - l2 * l2) / (2 * l1 * l2);
  const bend = Math.acos(Math.min(1, Math.max(-1, cosine)));
  const angles = [bend, -bend].map((second) => {
    const first = Math.atan2(wy, wx) - Math.atan2(l2 * Math.sin(second), l1 + l2 * Math.cos(second));
    return [first, second, angle - first - second].map((value) => Math.atan2(Math.sin(value), Math.cos(value)));
  });
  const shownAngles = (row: number[]): string => row.map((value) => `${text(value / degree, 1)}°`).join(", ");
  return element(
    "ol",
    { class: "steps" },
    element("li", {}, `The tool: x = ${text(x, 2)}, y = ${text(y, 2)}, θ = ${text(angle / degree, 1)}°.`),
    element("li", {}, `Joint 3, two metres before it: (${text(wx, 2)}, ${text(wy, 2)}).`),
    element("li", {}, `Its distance from the base: ${text(Math.sqrt(square), 2)}, so cos θ₂ = ${text(cosine, 3)}.`),
    element("li", {}, `One elbow: θ = (${shownAngles(angles[0] ?? [])}).`),
    element("li", {}, `The other: θ = (${shownAngles(angles[1] ?? [])}).`),
  );
}
