import type { Skeleton } from "../../core/types.js";
import type { Hand } from "../picture.js";
import type { Pixel } from "../labels.js";
import type { PlaneView } from "./plane_view.js";

/** What the hand needs of the picture. */
export interface Held {
  view: PlaneView;
  /** As it is shown now. */
  pose(): ArrayLike<number>;
  skeleton(): Skeleton;
  q(): number[];
  waypoint(index: number): number[];
  /** Draws again after the view has moved. */
  moved(): void;
  home(): void;
  clicked(point: Pixel): void;
}

type Drag = (to: Pixel, released: boolean) => void;

const stillness = 4; // pixels between press and release of a click
const keyStep = 0.02; // of the size of the picture

/** Mouse, touch, pen and keys in the picture of a planar arm: the tool, the links and the waypoints are dragged, the
 * plane is moved and magnified by the wheel or two fingers. */
export class PlaneHand {
  private readonly fingers = new Map<number, Pixel>();
  private drag: Drag | null = null;
  private travelled = 0;

  constructor(
    private readonly root: SVGSVGElement,
    private readonly held: Held,
    private readonly hand: Hand,
  ) {
    root.addEventListener("pointerdown", (event) => this.press(event));
    root.addEventListener("pointermove", (event) => this.move(event));
    for (const end of ["pointerup", "pointercancel"] as const)
      root.addEventListener(end, (event) => this.release(event));
    root.addEventListener("wheel", (event) => this.wheel(event), { passive: false });
    root.addEventListener("dblclick", () => held.home());
    root.addEventListener("keydown", (event) => this.key(event));
  }

  private at(event: MouseEvent): Pixel {
    const { left, top } = this.root.getBoundingClientRect();
    return [event.clientX - left, event.clientY - top];
  }

  private press(event: PointerEvent): void {
    if (event.button !== 0) return;
    const at = this.at(event);
    this.fingers.set(event.pointerId, at);
    this.travelled = 0;
    this.root.setPointerCapture(event.pointerId);
    if (this.fingers.size > 1) return this.end(); // two fingers move the plane
    const [what = "", index = "0"] = (event.target as Element).getAttribute("data-grab")?.split(" ") ?? [];
    this.drag = this.begin(what, Number(index), at);
    if (!this.drag) return;
    this.root.dataset["grabbed"] = what;
    this.hand.pressed();
  }

  /** Ends what one finger drags. */
  private end(): void {
    if (!this.drag) return;
    this.drag = null;
    delete this.root.dataset["grabbed"];
    this.hand.released();
  }

  private begin(what: string, index: number, at: Pixel): Drag | null {
    if (what === "tool") return this.dragTool(at);
    if (what === "turn") return this.turnTool(at);
    if (what === "joint") return this.dragJoint(index, at);
    if (what !== "waypoint") return null;
    const pose = this.held.waypoint(index);
    const from = this.held.view.pixel(pose.slice(12, 14));
    return (to, released) => this.hand.waypoint(index, this.shifted(pose, from, at, to), released);
  }

  /** A pose whose origin has moved as far as the finger. */
  private shifted(pose: ArrayLike<number>, origin: Pixel, from: Pixel, to: Pixel): number[] {
    const [x, y] = this.held.view.world([origin[0] + to[0] - from[0], origin[1] + to[1] - from[1]]);
    return Array.from(pose).with(12, x).with(13, y);
  }

  private dragTool(from: Pixel): Drag {
    const pose = Array.from(this.held.pose());
    const origin = this.held.view.pixel(pose.slice(12, 14));
    return (to, released) => {
      if (!released) this.hand.tool(this.shifted(pose, origin, from, to));
    };
  }

  private turnTool(from: Pixel): Drag {
    const pose = Array.from(this.held.pose());
    const [x, y] = this.held.view.pixel(pose.slice(12, 14));
    const angle = (at: Pixel): number => Math.atan2(y - at[1], at[0] - x);
    return (to, released) => {
      if (!released) this.hand.tool(turned(pose, angle(to) - angle(from)));
    };
  }

  private dragJoint(k: number, from: Pixel): Drag | null {
    const joint = this.held.skeleton().joints[k];
    const begin = this.held.q()[k];
    if (!joint || begin === undefined) return null;
    const { view } = this.held;
    const [cx, cy] = view.pixel(joint.centre);
    if (joint.kind === "prismatic") {
      const [dx = 0, dy = 0] = joint.direction;
      return (to, released) => {
        const along = (dx * (to[0] - from[0]) - dy * (to[1] - from[1])) / view.scale;
        if (!released) this.hand.joint(k, begin + along);
      };
    }
    const sense = (joint.direction[2] ?? 1) < 0 ? -1 : 1;
    const angle = ([x, y]: Pixel): number => Math.atan2(cy - y, x - cx);
    let [last, turn] = [angle(from), 0];
    return (to, released) => {
      const now = angle(to);
      turn += Math.atan2(Math.sin(now - last), Math.cos(now - last));
      last = now;
      if (!released) this.hand.joint(k, begin + sense * turn);
    };
  }

  private move(event: PointerEvent): void {
    const before = this.fingers.get(event.pointerId);
    if (!before) return;
    const at = this.at(event);
    const other = [...this.fingers].find(([id]) => id !== event.pointerId)?.[1];
    this.fingers.set(event.pointerId, at);
    this.travelled += Math.hypot(at[0] - before[0], at[1] - before[1]);
    if (other) return this.pinch(before, at, other);
    if (this.drag) return this.drag(at, false);
    if (this.travelled < stillness) return;
    this.held.view.move(before, at, 1);
    this.held.moved();
  }

  private pinch(before: Pixel, at: Pixel, other: Pixel): void {
    const span = (a: Pixel): number => Math.max(1, Math.hypot(a[0] - other[0], a[1] - other[1]));
    const middle = (a: Pixel): Pixel => [(a[0] + other[0]) / 2, (a[1] + other[1]) / 2];
    this.held.view.move(middle(before), middle(at), span(at) / span(before));
    this.held.moved();
  }

  private release(event: PointerEvent): void {
    if (!this.fingers.delete(event.pointerId)) return;
    const at = this.at(event);
    const { drag } = this;
    if (drag) {
      drag(at, true);
      this.end();
    } else if (this.travelled < stillness && event.type === "pointerup") this.held.clicked(at);
  }

  private wheel(event: WheelEvent): void {
    event.preventDefault();
    const lines = event.deltaMode === 1 ? 16 : 1;
    const at = this.at(event);
    this.held.view.move(at, at, Math.exp(-0.0015 * lines * event.deltaY));
    this.held.moved();
  }

  /** Arrows move the tool, with Shift by a tenth; Q and E turn it; + and − magnify, 0 shows the whole arm. */
  private key(event: KeyboardEvent): void {
    if (event.ctrlKey || event.metaKey || event.altKey) return;
    const { view } = this.held;
    const span = Math.min(view.plotWidth, view.plotHeight) / view.scale;
    const far = keyStep * span * (event.shiftKey ? 0.1 : 1);
    const angle = (event.shiftKey ? 0.5 : 5) * (Math.PI / 180);
    const pose = Array.from(this.held.pose());
    const by = (dx: number, dy: number): void => {
      this.hand.tool(pose.with(12, (pose[12] ?? 0) + dx).with(13, (pose[13] ?? 0) + dy));
    };
    const zoom = (factor: number): void => {
      view.move(view.middle, view.middle, factor);
      this.held.moved();
    };
    const keys: Record<string, () => void> = {
      ArrowLeft: () => by(-far, 0),
      ArrowRight: () => by(far, 0),
      ArrowUp: () => by(0, far),
      ArrowDown: () => by(0, -far),
      q: () => this.hand.tool(turned(pose, angle)),
      e: () => this.hand.tool(turned(pose, -angle)),
      "+": () => zoom(1.2),
      "-": () => zoom(1 / 1.2),
      "0": () => this.held.home(),
    };
    const act = keys[event.key] ?? keys[event.key.toLowerCase()];
    if (!act) return;
    event.preventDefault();
    act();
  }
}

/** A pose turned about its own origin, in the plane. */
function turned(pose: number[], angle: number): number[] {
  const [c, s] = [Math.cos(angle), Math.sin(angle)];
  const column = (k: number): number[] => [
    c * (pose[k] ?? 0) - s * (pose[k + 1] ?? 0),
    s * (pose[k] ?? 0) + c * (pose[k + 1] ?? 0),
    pose[k + 2] ?? 0,
    0,
  ];
  return [...column(0), ...column(4), ...column(8), ...pose.slice(12)];
}
