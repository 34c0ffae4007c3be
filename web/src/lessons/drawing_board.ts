import { element } from "../elements/element.js";
import { children, pathOf, set, svg } from "../elements/svg.js";
import { changeTo, drawnAt, movedParts, type Part } from "./drawn_arm.js";
import { checkButton, exercise, judged, verdict, type Exercise, type ExerciseContext } from "./exercise.js";
import { partsText } from "./judges.js";

const scale = 64; // units of the drawing for a metre
const [left, right, low, high] = [-0.75, 3.25, -0.75, 2.5]; // m
const snap = 0.5; // m
const most = 8; // parts
const kinds = { R: "Joint R", P: "Joint P", tool: "Tool" };
const drawnArm = "rp";
type Kind = Part["kind"];

const at = (x: number, y: number): [number, number] => [(x - left) * scale, (high - y) * scale];
const snapped = (value: number, from: number, to: number): number =>
  Math.min(to, Math.max(from, snap * Math.round(value / snap)));

/** An arm in lines: its parts in their order, with their symbols. */
function place(group: SVGGElement, parts: Part[], poses: readonly (readonly number[])[]): void {
  const points = poses.map(([x = 0, y = 0]) => at(x, y));
  const [line, ...symbols] = children<SVGElement>(group, 1 + parts.length, () => svg("path"));
  set(line as SVGElement, { class: "link", d: points.length > 1 ? pathOf(points) : "" });
  parts.forEach(({ kind }, i) => {
    const [px, py] = points[i] ?? [0, 0];
    const angle = (-(poses[i]?.[2] ?? 0) * 180) / Math.PI;
    const shape =
      kind === "R"
        ? "M-7 0a7 7 0 1 0 14 0a7 7 0 1 0 -14 0"
        : kind === "P"
          ? "M-8 -6h16v12h-16Z"
          : "M0 0h20M20 0l-6 -3M20 0l-6 3M0 0v-20M0 -20l-3 6M0 -20l3 6";
    set(symbols[i] as SVGElement, {
      class: kind === "tool" ? "frame" : "joint",
      d: shape,
      transform: `translate(${px} ${py}) rotate(${angle})`,
    });
  });
}

/** The board: a click places the next part, and so does Enter at the cross, which the arrow keys move. */
class Board {
  readonly root = svg("svg", {
    class: "board",
    viewBox: `0 0 ${(right - left) * scale} ${(high - low) * scale}`,
    tabindex: 0,
    role: "application",
    "aria-label": "Drawing: arrow keys move the cross, Enter places a part",
  });
  private readonly parts = svg("g", { class: "drawn" });
  private readonly compared = svg("g", { class: "drawn moved" });
  private readonly wanted = svg("g", { class: "drawn wanted" });
  private readonly cross = svg("path", { class: "cross", d: "M-6 0H6M0 -6V6" });
  private cursor: [number, number] = [0, 0];

  /** `add` places a part; `moved` says where a key has moved the cross, which the eye sees. */
  constructor(
    private readonly add: (x: number, y: number) => void,
    private readonly moved: (x: number, y: number) => void,
  ) {
    this.root.append(grid(), this.wanted, this.compared, this.parts, this.cross);
    this.root.addEventListener("pointerdown", (event) => {
      if (event.button !== 0) return;
      const box = this.root.getBoundingClientRect();
      const metres = (right - left) / box.width;
      this.go(left + (event.clientX - box.x) * metres, high - (event.clientY - box.y) * metres);
      this.add(...this.cursor);
    });
    this.root.addEventListener("keydown", (event) => this.key(event));
    this.go(0, 0);
  }

  show(drawn: Part[]): void {
    place(
      this.parts,
      drawn,
      drawn.map(({ x, y }) => [x, y, 0]),
    );
    this.compare([], null);
  }

  /** The drawing and the arm RP, both moved to a configuration; null: neither. */
  compare(drawn: Part[], q: [number, number] | null): void {
    const real: Part[] = [
      { kind: "R", x: 0, y: 0 },
      { kind: "P", x: 1, y: 0 },
      { kind: "tool", x: 1 + drawnAt.slide, y: 0 },
    ];
    place(this.compared, q ? drawn : [], q ? movedParts(drawn, changeTo(drawn, q)) : []);
    place(this.wanted, q ? real : [], q ? movedParts(real, changeTo(real, q)) : []);
  }

  private go(x: number, y: number): void {
    this.cursor = [snapped(x, left + 0.25, right - 0.25), snapped(y, low + 0.25, high)];
    const [px, py] = at(...this.cursor);
    set(this.cross, { transform: `translate(${px} ${py})` });
  }

  private key(event: KeyboardEvent): void {
    const steps: Record<string, [number, number]> = {
      ArrowLeft: [-snap, 0],
      ArrowRight: [snap, 0],
      ArrowUp: [0, snap],
      ArrowDown: [0, -snap],
    };
    const step = steps[event.key];
    if (step) {
      this.go(this.cursor[0] + step[0], this.cursor[1] + step[1]);
      this.moved(...this.cursor);
    } else if (event.key === "Enter" || event.key === " ") this.add(...this.cursor);
    else return;
    event.preventDefault();
  }
}

/** The board without a drawing, for paper. */
export function emptyBoard(): SVGSVGElement {
  return svg("svg", { class: "board", viewBox: `0 0 ${(right - left) * scale} ${(high - low) * scale}` }, grid());
}

function grid(): SVGGElement {
  const lines: string[] = [];
  for (let x = Math.ceil(left / snap) * snap; x <= right; x += snap) lines.push(pathOf([at(x, low), at(x, high)]));
  for (let y = Math.ceil(low / snap) * snap; y <= high; y += snap) lines.push(pathOf([at(left, y), at(right, y)]));
  const axes = pathOf([at(left, 0), at(right, 0)]) + pathOf([at(0, low), at(0, high)]);
  const text = (x: number, y: number, words: string): SVGElement => {
    const [px, py] = at(x, y);
    return svg("text", { x: px + 3, y: py + 12 }, words);
  };
  return svg(
    "g",
    {},
    svg("path", { class: "grid", d: lines.join("") }),
    svg("path", { class: "zero", d: axes }),
    ...[1, 2, 3].map((x) => text(x, 0, String(x))),
    ...[1, 2].map((y) => text(0, y, String(y))),
  );
}

/** The student draws the arm RP: joints and tool are placed with the mouse, and links join them. */
export function drawingExercise(context: ExerciseContext): Exercise {
  const answer = verdict();
  const list = element("p", { class: "quiet", "aria-live": "polite" });
  let parts: Part[] = [];
  let kind: Kind = "R";
  const choices = (Object.keys(kinds) as Kind[]).map((value) => {
    const button = element("button", { type: "button", "aria-pressed": String(value === kind) }, kinds[value]);
    button.addEventListener("click", () => choose(value));
    return { value, button };
  });
  const choose = (next: Kind): void => {
    kind = next;
    for (const { value, button } of choices) button.setAttribute("aria-pressed", String(value === kind));
    say();
  };
  const isComplete = (): boolean => parts.at(-1)?.kind === "tool" || parts.length >= most; // nothing is beyond the tool
  const say = (): void => {
    const placed = parts.map(({ kind, x, y }) => `${kind} at (${x}, ${y})`).join(", ");
    const next = isComplete() ? "" : `Next part: ${kinds[kind]}.`;
    list.textContent = placed === "" ? next : `${placed}. ${next}`.trim();
  };
  const take = (next: Part[]): void => {
    parts = next;
    board.show(parts);
    say();
    answer.show({ solved: false, says: "" });
  };
  const add = (x: number, y: number): void => {
    if (isComplete()) return;
    take([...parts, { kind, x, y }]);
    choose(kind === "R" ? "P" : "tool");
  };
  const cross = element("p", { class: "unseen", "aria-live": "polite" });
  const board = new Board(add, (x, y) => (cross.textContent = `Cross at (${x}, ${y})`));
  const back = element("button", { type: "button", onclick: () => take(parts.slice(0, -1)) }, "Take back");
  const check = (): void => {
    const found = judged(context, "draw-rp", partsText(parts));
    const [turn, slide] = found.at ?? [];
    board.compare(parts, turn === undefined || slide === undefined ? null : [turn, slide]);
    answer.show(found);
    if (found.solved)
      context.services.store.set({ arm: { text: drawnArm }, q: [drawnAt.turn, drawnAt.slide], goal: null });
  };
  board.show(parts);
  say();
  const tools = element("p", { class: "pair" }, ...choices.map(({ button }) => button), back);
  const holder = element("div");
  holder.append(board.root, cross);
  const root = exercise(check, tools, holder, list, checkButton(), answer.root);
  return { root, solvedArm: drawnArm, answer: () => partsText(parts) };
}
