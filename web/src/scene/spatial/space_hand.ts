import { Plane, Raycaster, Vector2, Vector3, Matrix4 } from "three";
import type { Skeleton } from "../../core/types.js";
import type { Hand } from "../picture.js";
import type { Pixel } from "../labels.js";
import type { ArmFigure } from "./arm_figure.js";
import type { Pointed } from "./hover.js";
import type { RobotMeshes } from "./robot_meshes.js";
import type { Stage } from "./stage.js";

/** What the hand needs of the picture. */
export interface Held {
  stage: Stage;
  figure: ArmFigure;
  /** The meshes of the links, if they are shown. */
  meshes(): RobotMeshes | null;
  /** Whether the arrows at the tool have been taken, and what the one does that the mouse points at. */
  handleTaken(): boolean;
  handlePointed(): string;
  canHold(): boolean;
  /** The obstacle on a ray that can be taken hold of, and where it stands. */
  obstacleAt(ray: Raycaster): { index: number; name: string; distance: number } | null;
  obstaclePose(index: number): number[];
  pose(): ArrayLike<number>;
  poses(): ArrayLike<number>[];
  skeleton(): Skeleton;
  q(): number[];
  waypoints(): number[][];
  /** The waypoint whose label is at a pixel; -1: none. */
  waypointLabelled(pixel: Pixel): number;
  /** The mouse points at something, or at nothing, at this pixel. */
  pointed(what: Pointed | null, mouse: Pixel): void;
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
  private hovering: PointerEvent | null = null;

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
    canvas.addEventListener("pointerleave", () => held.pointed(null, [0, 0]));
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
    const pointed = this.under(event);
    this.drag = pointed && this.begin(event, pointed);
    if (!this.drag) return;
    if (pointed?.what !== "link" && pointed?.what !== "obstacle") this.held.pointed(null, [0, 0]); // a ring would stay behind
    this.held.stage.controls.enabled = false;
    this.held.stage.canvas.setPointerCapture(event.pointerId);
    this.held.stage.canvas.dataset["grabbed"] = "";
    this.hand.pressed();
  };

  /** What is under the mouse or the finger. */
  private under(event: PointerEvent): Pointed | null {
    const { held } = this;
    if (!held.canHold()) return null;
    const reach = event.pointerType === "touch" ? near.touch : near.mouse;
    const [mx, my] = this.pixelOf(event);
    const pixel = (pose: ArrayLike<number>): Pixel => held.stage.pixel(new Vector3(pose[12], pose[13], pose[14]));
    const isNear = ([x, y]: Pixel): boolean => Math.hypot(mx - x, my - y) <= reach;
    const places = held.waypoints().map(pixel);
    const nearest = places.findIndex(isNear);
    const index = nearest < 0 ? held.waypointLabelled([mx, my]) : nearest;
    if (index >= 0) return { what: "waypoint", index, at: places[index] ?? [mx, my] };
    const at = pixel(held.pose());
    if (isNear(at)) return { what: "tool", at };
    const link = this.hit(event);
    const body = held.obstacleAt(this.ray(event));
    if (body && !(link && link.distance < body.distance)) return { what: "obstacle", ...body };
    return link && { what: "link", joint: link.joint };
  }

  private begin(event: PointerEvent, pointed: Pointed): Drag | null {
    switch (pointed.what) {
      case "waypoint": {
        const { index } = pointed;
        const pose = this.held.waypoints()[index] ?? [];
        return this.dragPose(pose, event, (to, released) => this.hand.waypoint(index, to, released));
      }
      case "tool":
        return this.dragPose(
          Array.from(this.held.pose()),
          event,
          (to, released) => void (released || this.hand.tool(to)),
        );
      case "obstacle": {
        const { index } = pointed;
        this.hand.obstacle(index, null);
        const pose = this.held.obstaclePose(index);
        return this.dragPose(pose, event, (to, released) => void (released || this.hand.obstacle(index, to)));
      }
      case "link":
        return this.dragLink(event);
      default:
        return null;
    }
  }

  private pixelOf(event: PointerEvent): Pixel {
    const { left, top } = this.holder.getBoundingClientRect();
    return [event.clientX - left, event.clientY - top];
  }

  /** Shows what the mouse points at, once a picture: a finger points at nothing. */
  private hover(event: PointerEvent): void {
    if (event.pointerType === "touch" || event.buttons !== 0) return;
    const isWaiting = this.hovering !== null;
    this.hovering = event;
    if (isWaiting) return;
    requestAnimationFrame(() => {
      const { hovering, held } = this;
      this.hovering = null;
      if (!hovering || !held.stage.canvas.isConnected) return;
      const does = held.canHold() ? held.handlePointed() : "";
      held.pointed(does === "" ? this.under(hovering) : { what: "handle", does }, this.pixelOf(hovering));
    });
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

  /** The nearest link below the mouse, by its joint. */
  private hit(event: PointerEvent): { joint: number; point: Vector3; distance: number } | null {
    const { figure } = this.held;
    const meshes = this.held.meshes();
    for (const { object, point, distance } of this.ray(event).intersectObjects(
      meshes ? [figure, meshes] : [figure],
      true,
    )) {
      const joint = meshes?.jointOf(object) ?? figure.jointOf(object);
      if (joint !== null) return { joint, point, distance };
    }
    return null;
  }

  /** Turns or slides the joint of the link below the finger, so that the grasped point follows the finger. */
  private dragLink(from: PointerEvent): Drag | null {
    const hit = this.hit(from);
    if (!hit) return null;
    const k = hit.joint;
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
    this.hover(event);
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
