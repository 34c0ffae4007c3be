import { Plane, Raycaster, Vector2, Vector3, Matrix4 } from "three";
import type { Skeleton } from "../../core/types.js";
import type { Hand } from "../picture.js";
import type { ArmFigure } from "./arm_figure.js";
import type { Stage } from "./stage.js";

/** What the hand needs of the picture. */
export interface Held {
  stage: Stage;
  figure: ArmFigure;
  /** Whether the arrows at the tool have been taken. */
  handleTaken(): boolean;
  canHold(): boolean;
  pose(): ArrayLike<number>;
  poses(): ArrayLike<number>[];
  skeleton(): Skeleton;
  q(): number[];
  waypoints(): number[][];
  clicked(event: PointerEvent): void;
}

type Drag = (event: PointerEvent, released: boolean) => void;

const stillness = 4; // pixels between press and release of a click
const near = { mouse: 14, touch: 26 }; // pixels around the tool and a waypoint
const keyStep = 0.01; // of the size of the picture

/** Mouse, touch and keys in the picture of a spatial arm: the tool and waypoints are dragged in the plane of the
 * screen, a link turns its joint. What is beside them turns the view. */
export class SpaceHand {
  private drag: Drag | null = null;
  private pressed: { x: number; y: number; id: number } | null = null;
  private fingers = 0;

  constructor(
    private readonly holder: HTMLElement,
    private readonly held: Held,
    private readonly hand: Hand,
    private readonly size: number,
  ) {
    const { canvas } = held.stage;
    // Before the listeners of the camera, which this may stop.
    holder.addEventListener("pointerdown", this.press, { capture: true });
    canvas.addEventListener("pointermove", this.move);
    for (const end of ["pointerup", "pointercancel"] as const) canvas.addEventListener(end, this.release);
    canvas.addEventListener("keydown", this.key);
    canvas.addEventListener("dblclick", () => held.stage.home());
    canvas.tabIndex = 0;
    canvas.setAttribute("role", "application");
  }

  dispose(): void {
    this.holder.removeEventListener("pointerdown", this.press, { capture: true });
  }

  private readonly press = (event: PointerEvent): void => {
    if (event.target !== this.held.stage.canvas || event.button !== 0) return;
    ++this.fingers;
    this.pressed = { x: event.clientX, y: event.clientY, id: event.pointerId };
    if (this.fingers > 1 || this.held.handleTaken()) return;
    this.drag = this.begin(event);
    if (!this.drag) return;
    this.held.stage.controls.enabled = false;
    this.held.stage.canvas.setPointerCapture(event.pointerId);
    this.held.stage.canvas.dataset["grabbed"] = "";
    this.hand.pressed();
  };

  private begin(event: PointerEvent): Drag | null {
    if (!this.held.canHold()) return null;
    const reach = event.pointerType === "touch" ? near.touch : near.mouse;
    const isNear = (pose: ArrayLike<number>): boolean => {
      const [x, y] = this.held.stage.pixel(new Vector3(pose[12], pose[13], pose[14]));
      const { left, top } = this.holder.getBoundingClientRect();
      return Math.hypot(event.clientX - left - x, event.clientY - top - y) <= reach;
    };
    const waypoints = this.held.waypoints();
    const index = waypoints.findIndex(isNear);
    if (index >= 0)
      return this.dragPose(waypoints[index] ?? [], event, (pose, released) =>
        this.hand.waypoint(index, pose, released),
      );
    const pose = this.held.pose();
    if (isNear(pose))
      return this.dragPose(Array.from(pose), event, (to, released) => void (released || this.hand.tool(to)));
    return this.dragLink(event);
  }

  private ray(event: PointerEvent): Raycaster {
    const { left, top, width, height } = this.holder.getBoundingClientRect();
    const ray = new Raycaster();
    const at = new Vector2((2 * (event.clientX - left)) / width - 1, 1 - (2 * (event.clientY - top)) / height);
    ray.setFromCamera(at, this.held.stage.camera);
    return ray;
  }

  /** Drags a pose in the plane through its origin that faces the viewer. */
  private dragPose(pose: number[], from: PointerEvent, moved: (pose: number[], released: boolean) => void): Drag {
    const origin = new Vector3(pose[12], pose[13], pose[14]);
    const facing = this.held.stage.camera.getWorldDirection(new Vector3());
    const plane = new Plane().setFromNormalAndCoplanarPoint(facing, origin);
    const hit = (event: PointerEvent): Vector3 | null => this.ray(event).ray.intersectPlane(plane, new Vector3());
    const grasp = hit(from)?.sub(origin) ?? new Vector3();
    return (event, released) => {
      const point = hit(event)?.sub(grasp);
      if (point) moved(pose.with(12, point.x).with(13, point.y).with(14, point.z), released);
    };
  }

  /** Turns or slides the joint of the link below the finger, so that the grasped point follows the finger. */
  private dragLink(from: PointerEvent): Drag | null {
    const [hit] = this.ray(from)
      .intersectObject(this.held.figure, true)
      .filter(({ object }) => this.held.figure.jointOf(object) !== null);
    const k = hit ? this.held.figure.jointOf(hit.object) : null;
    if (!hit || k === null) return null;
    const frame = (): Matrix4 => new Matrix4().fromArray(Array.from(this.held.poses()[k + 1] ?? []));
    const grasped = hit.point.clone().applyMatrix4(frame().invert());
    return (event, released) => {
      const joint = this.held.skeleton().joints[k];
      const value = this.held.q()[k];
      if (!joint || value === undefined || released) return;
      const point = grasped.clone().applyMatrix4(frame());
      const axis = new Vector3(...joint.direction);
      const rate = joint.kind === "prismatic" ? axis : axis.cross(point.clone().sub(new Vector3(...joint.centre)));
      const small = 1e-4 * this.size;
      const [x, y] = this.held.stage.pixel(point);
      const [nx, ny] = this.held.stage.pixel(
        point.clone().addScaledVector(rate, small / Math.max(rate.length(), 1e-12)),
      );
      const speed = Math.max(rate.length(), 1e-12) / small;
      const [tx, ty] = [(nx - x) * speed, (ny - y) * speed]; // pixels for a unit of the joint
      const { left, top } = this.holder.getBoundingClientRect();
      const along = tx * (event.clientX - left - x) + ty * (event.clientY - top - y);
      const softened = tx * tx + ty * ty + 400; // where the axis lies in the screen, the finger moves little
      const limit = joint.kind === "prismatic" ? 0.2 * this.size : 0.5;
      this.hand.joint(k, value + Math.min(limit, Math.max(-limit, along / softened)));
    };
  }

  private readonly move = (event: PointerEvent): void => {
    if (event.pointerId === this.pressed?.id) this.drag?.(event, false);
  };

  private readonly release = (event: PointerEvent): void => {
    this.fingers = Math.max(0, this.fingers - 1);
    const { pressed, drag } = this;
    if (event.pointerId !== pressed?.id) return;
    this.pressed = null;
    if (drag) {
      this.drag = null;
      drag(event, true);
      this.held.stage.controls.enabled = true;
      delete this.held.stage.canvas.dataset["grabbed"];
      this.hand.released();
    }
    const far = Math.hypot(event.clientX - pressed.x, event.clientY - pressed.y);
    if (far < stillness && event.type === "pointerup") this.held.clicked(event);
  };

  /** Arrows move the tool in x and y, Page Up and Down in z, with Shift by a tenth. */
  private readonly key = (event: KeyboardEvent): void => {
    if (event.ctrlKey || event.metaKey || event.altKey) return;
    const far = keyStep * this.size * (event.shiftKey ? 0.1 : 1);
    const moves: Record<string, [number, number]> = {
      ArrowLeft: [13, far],
      ArrowRight: [13, -far],
      ArrowUp: [12, far],
      ArrowDown: [12, -far],
      PageUp: [14, far],
      PageDown: [14, -far],
    };
    const move = moves[event.key];
    if (event.key === "0") this.held.stage.home();
    if (!move || !this.held.canHold()) return;
    event.preventDefault();
    const pose = Array.from(this.held.pose());
    this.hand.tool(pose.with(move[0], (pose[move[0]] ?? 0) + move[1]));
  };
}
