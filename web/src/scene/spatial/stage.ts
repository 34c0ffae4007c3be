import {
  AmbientLight,
  Color,
  DirectionalLight,
  GridHelper,
  PerspectiveCamera,
  Scene,
  Vector3,
  WebGLRenderer,
} from "three";
import { OrbitControls } from "three/addons/controls/OrbitControls.js";
import { element } from "../../elements/element.js";
import { reducedMotion } from "../../elements/motion.js";
import { onTheme, resolved } from "../colours.js";
import { drawOrder } from "./arm_figure.js";
import { FloorShadow } from "./floor_shadow.js";
import { roundStep } from "../ticks.js";

const lostPicture = "The graphics card has lost the picture. It comes back as soon as the browser can restore it.";
const noPicture =
  "This arm moves in space, and its picture needs WebGL, which this browser does not have or has switched off. " +
  "All numbers beside it are computed all the same; planar arms, such as rrr, are drawn without WebGL.";

/** Where the viewer of `beeline draw` stands, degrees. */
const azimuth = -50;
const elevation = 25;
const radian = Math.PI / 180;
const glide = 400; // milliseconds of the camera to where it sees the whole arm

function rendererOrNull(): WebGLRenderer | null {
  try {
    return new WebGLRenderer({ antialias: true, stencil: true, preserveDrawingBuffer: true });
  } catch {
    return null;
  }
}

/** Scene, camera and light. Draws a picture only after changed(): a page at rest costs nothing. */
export class Stage {
  readonly scene = new Scene();
  readonly camera: PerspectiveCamera;
  readonly controls: OrbitControls;
  /** What the mouse acts on. */
  readonly canvas: HTMLElement;
  private readonly renderer: WebGLRenderer | null;
  private readonly shadow: FloorShadow;
  private readonly lost = element("p", { class: "no-picture", role: "status" }, lostPicture);
  private grid: GridHelper | null = null;
  private waiting = false;
  private disposed = false;
  /** Where the camera was when it began to follow the arm; null: it is at rest. */
  private following: { begin: number; target: Vector3; offset: Vector3 } | null = null;
  private readonly endTheme: () => void;
  private readonly resize: ResizeObserver;

  /** `size`: of what can be seen, `ground`: the place of the ground, metres; `whole`: the sphere around all that is
   * drawn. `drawn` is called after each picture. Without WebGL there is a sentence instead of the picture. */
  constructor(
    private readonly holder: HTMLElement,
    private readonly size: number,
    private readonly whole: () => { centre: Vector3; radius: number },
    private ground: Vector3,
    private readonly drawn: () => void,
  ) {
    this.renderer = rendererOrNull();
    this.renderer?.setPixelRatio(Math.min(devicePixelRatio, 2));
    this.canvas = this.renderer?.domElement ?? element("p", { class: "no-picture", role: "status" }, noPicture);
    this.camera = new PerspectiveCamera(30, 1, size / 100, size * 100);
    this.camera.up.set(0, 0, 1);
    holder.replaceChildren(this.canvas);
    this.canvas.addEventListener("webglcontextlost", this.lose);
    this.canvas.addEventListener("webglcontextrestored", this.restore);
    this.controls = new OrbitControls(this.camera, this.canvas);
    this.canvas.style.cursor = ""; // the page's styles have it
    this.controls.addEventListener("change", () => this.changed());
    this.controls.addEventListener("start", () => (this.following = null)); // a hand has the camera
    const sun = new DirectionalLight(0xffffff, 1.1);
    sun.position.set(2 * size, -3 * size, 5 * size);
    this.scene.add(new AmbientLight(0xffffff, 2.3), sun);
    this.shadow = new FloorShadow(1.3 * size);
    this.shadow.renderOrder = drawOrder.shadow;
    this.scene.add(this.shadow);
    this.endTheme = onTheme(() => this.paint());
    this.paint();
    this.resize = new ResizeObserver(() => this.fit());
    this.resize.observe(holder);
    this.fit();
    this.home();
  }

  get hasPicture(): boolean {
    return this.renderer !== null;
  }

  /** Draws the next picture soon. */
  changed(): void {
    if (this.waiting) return;
    this.waiting = true;
    requestAnimationFrame(() => {
      this.waiting = false;
      if (this.disposed) return; // three draws into a lost context with errors
      this.render();
      this.drawn();
    });
  }

  /** The arm has moved: so does its shadow. */
  armChanged(): void {
    this.shadow.changed();
    this.changed();
  }

  /** Puts the ground below the arm. */
  setGround(ground: Vector3): void {
    if (ground.equals(this.ground)) return;
    this.ground = ground;
    this.paint();
  }

  /** Puts the camera where the whole arm is seen. */
  home(): void {
    this.following = null;
    const level = Math.cos(elevation * radian);
    const direction = new Vector3(
      level * Math.cos(azimuth * radian),
      level * Math.sin(azimuth * radian),
      Math.sin(elevation * radian),
    );
    const { centre, radius } = this.whole();
    this.controls.target.copy(centre);
    this.camera.position.copy(centre).addScaledVector(direction, this.distanceFor(radius));
    this.controls.update();
    this.changed();
  }

  /** Moves the camera away until a sphere is seen, metres; never nearer. */
  retreat(centre: Vector3, radius: number): void {
    const { camera, controls } = this;
    const far = this.distanceFor(radius + centre.distanceTo(controls.target));
    const offset = camera.position.clone().sub(controls.target);
    camera.position.copy(controls.target).add(offset.setLength(Math.max(offset.length(), far)));
    controls.update();
    this.changed();
  }

  /** Whether a point is in the picture. */
  sees(point: Vector3): boolean {
    this.camera.updateMatrixWorld();
    return point
      .clone()
      .project(this.camera)
      .toArray()
      .every((value) => Math.abs(value) <= 1);
  }

  /** Moves the camera in a moment to where it sees the whole arm; its direction stays. */
  follow(): void {
    if (this.following) return;
    const { camera, controls } = this;
    const target = controls.target.clone();
    this.following = { begin: performance.now(), target, offset: camera.position.clone().sub(target) };
    this.glide();
  }

  private readonly glide = (): void => {
    if (!this.following || this.disposed) return;
    const { begin, target, offset } = this.following;
    const time = reducedMotion() ? 1 : Math.min(1, (performance.now() - begin) / glide);
    const part = time * time * (3 - 2 * time);
    const { centre, radius } = this.whole();
    const far = offset.length() + part * (this.distanceFor(radius) - offset.length());
    this.controls.target.lerpVectors(target, centre, part);
    this.camera.position.copy(this.controls.target).add(offset.clone().setLength(far));
    this.controls.update();
    this.changed();
    if (time < 1) requestAnimationFrame(this.glide);
    else this.following = null;
  };

  /** Azimuth and elevation of the camera, degrees. */
  viewer(): { azimuth: number; elevation: number } {
    const { x, y, z } = this.camera.position.clone().sub(this.controls.target);
    return { azimuth: Math.atan2(y, x) / radian, elevation: Math.atan2(z, Math.hypot(x, y)) / radian };
  }

  /** The pixel of a point of the world in the picture. */
  pixel(point: Vector3): [number, number] {
    const { x, y } = point.clone().project(this.camera);
    const { clientWidth: width, clientHeight: height } = this.holder;
    return [(0.5 + x / 2) * width, (0.5 - y / 2) * height];
  }

  /** Pixels for a metre in the middle of the picture. */
  get pixelsPerMetre(): number {
    const distance = this.camera.position.distanceTo(this.controls.target);
    return this.holder.clientHeight / (2 * distance * Math.tan((this.camera.fov * radian) / 2));
  }

  /** The picture as a canvas; null without WebGL. */
  snapshot(): HTMLCanvasElement | null {
    this.render();
    return this.renderer?.domElement ?? null;
  }

  dispose(): void {
    this.disposed = true;
    this.resize.disconnect();
    this.canvas.removeEventListener("webglcontextlost", this.lose);
    this.endTheme();
    this.controls.dispose();
    this.shadow.dispose();
    this.renderer?.dispose();
    this.renderer?.forceContextLoss(); // browsers have few contexts, and free them late by themselves
    this.canvas.remove();
    this.lost.remove();
  }

  private distanceFor(radius: number): number {
    const narrow = Math.min(1, this.camera.aspect) * Math.tan((this.camera.fov * radian) / 2);
    return radius * Math.sqrt(1 + 1 / narrow ** 2);
  }

  private readonly lose = (event: Event): void => {
    event.preventDefault(); // otherwise the browser does not restore it
    this.canvas.style.visibility = "hidden";
    this.holder.append(this.lost);
  };

  private readonly restore = (): void => {
    this.canvas.style.visibility = "";
    this.lost.remove();
    this.armChanged();
  };

  private render(): void {
    if (!this.renderer) return;
    this.shadow.update(this.renderer, this.scene);
    this.renderer.render(this.scene, this.camera);
  }

  private paint(): void {
    this.scene.background = new Color(resolved("--picture"));
    if (this.grid) this.scene.remove(this.grid);
    this.grid?.dispose();
    const cell = roundStep(this.size / 6);
    const cells = 2 * Math.ceil(this.size / cell);
    const line = new Color(resolved("--grid"));
    this.grid = new GridHelper(cells * cell, cells, line, line);
    this.grid.rotation.x = Math.PI / 2;
    this.grid.position.z = this.ground.z - 1e-3 * this.size; // below the foot and the shadow
    this.grid.renderOrder = drawOrder.ground;
    this.scene.add(this.grid);
    this.shadow.paint();
    this.shadow.put(this.ground.x, this.ground.y, this.ground.z - 5e-4 * this.size);
    this.armChanged();
  }

  private fit(): void {
    const { clientWidth: width, clientHeight: height } = this.holder;
    if (width === 0 || height === 0) return;
    this.renderer?.setSize(width, height);
    const before = this.distanceFor(1);
    this.camera.aspect = width / height;
    this.camera.updateProjectionMatrix();
    const offset = this.camera.position.clone().sub(this.controls.target); // as much as before stays in the picture
    this.camera.position.copy(this.controls.target).add(offset.multiplyScalar(this.distanceFor(1) / before));
    this.controls.update();
    this.changed();
  }
}
