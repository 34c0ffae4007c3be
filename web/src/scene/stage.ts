import {
  AmbientLight,
  Color,
  DirectionalLight,
  GridHelper,
  OrthographicCamera,
  type Object3D,
  PerspectiveCamera,
  Scene,
  Vector3,
  WebGLRenderer,
} from "three";
import { OrbitControls } from "three/addons/controls/OrbitControls.js";

/** The colours of the scene, in light and dark. */
interface Theme {
  background: number;
  grid: number;
  gridCentre: number;
}
const light: Theme = { background: 0xf7f8fa, grid: 0xdde2e8, gridCentre: 0xb8c2cc };
const dark: Theme = { background: 0x14181d, grid: 0x2a323b, gridCentre: 0x45515e };

const lostPicture = "The graphics card has lost the picture. It comes back as soon as the browser can restore it.";
const noPicture = "This browser has no WebGL, so there is no picture. The numbers beside it are computed all the same.";

/** What stands in the place of the picture. */
function sentence(text: string): HTMLElement {
  const made = document.createElement("p");
  made.setAttribute("role", "status");
  made.textContent = text;
  return made;
}

function rendererOrNull(): WebGLRenderer | null {
  try {
    return new WebGLRenderer({ antialias: true, preserveDrawingBuffer: true });
  } catch {
    return null;
  }
}

/** Scene, camera and light. Draws a picture only after changed(): a page at rest costs nothing. */
export class Stage {
  readonly scene = new Scene();
  readonly camera: PerspectiveCamera | OrthographicCamera;
  readonly controls: OrbitControls;
  /** What the mouse acts on. */
  readonly canvas: HTMLElement;
  private readonly renderer: WebGLRenderer | null;
  private readonly lost = sentence(lostPicture);
  private grid: GridHelper | null = null;
  private pointed: Object3D | null = null;
  private waiting = false;
  private disposed = false;
  private readonly darkness = matchMedia("(prefers-color-scheme: dark)");
  private readonly resize: ResizeObserver;

  /** `flat`: seen from above without perspective, for planar arms. `size`: of what is seen, `height`: of its middle,
   * metres. Without WebGL there is a sentence instead of the picture. */
  constructor(
    private readonly holder: HTMLElement,
    private readonly flat: boolean,
    private readonly size: number,
    private readonly height: number,
  ) {
    this.renderer = rendererOrNull();
    this.renderer?.setPixelRatio(Math.min(devicePixelRatio, 2));
    this.canvas = this.renderer?.domElement ?? sentence(noPicture);
    this.camera = flat
      ? new OrthographicCamera(-1, 1, 1, -1, -100 * size, 100 * size)
      : new PerspectiveCamera(40, 1, size / 100, size * 100);
    this.camera.up.set(0, flat ? 1 : 0, flat ? 0 : 1);
    holder.replaceChildren(this.canvas);
    this.canvas.addEventListener("webglcontextlost", this.lose);
    this.canvas.addEventListener("webglcontextrestored", this.restore);
    this.controls = new OrbitControls(this.camera, this.canvas);
    this.controls.enableRotate = !flat;
    this.controls.addEventListener("change", () => this.changed());
    this.home();
    const sun = new DirectionalLight(0xffffff, 2.2);
    sun.position.set(2 * size, -3 * size, 4 * size);
    this.scene.add(new AmbientLight(0xffffff, 1.4), sun);
    this.darkness.addEventListener("change", this.paint);
    this.paint();
    this.resize = new ResizeObserver(() => this.fit());
    this.resize.observe(holder);
    this.fit();
  }

  /** Draws the next picture soon. */
  changed(): void {
    if (this.waiting) return;
    this.waiting = true;
    requestAnimationFrame(() => {
      this.waiting = false;
      if (this.disposed) return; // three draws into a lost context with errors
      this.renderer?.render(this.scene, this.camera);
      this.writePoint();
    });
  }

  /** Keeps in the attribute data-tool of the picture's element where it shows an object, in pixels. */
  pointAt(object: Object3D): void {
    this.pointed = object;
  }

  /** Puts the camera where the whole arm is seen. */
  home(): void {
    const far = this.size;
    if (this.flat) this.camera.position.set(0, 0, far);
    else this.camera.position.set(1.5 * far, -1.9 * far, 1.3 * far);
    this.controls.target.set(0, 0, this.flat ? 0 : Math.max(far / 4, this.height));
    this.controls.update();
    this.changed();
  }

  /** Moves the camera away until a sphere around the middle of the picture is seen, metres; never nearer. */
  retreat(radius: number): void {
    const { camera, controls } = this;
    const offset = camera.position.clone().sub(controls.target);
    if (camera instanceof PerspectiveCamera) {
      const narrow = Math.min(1, camera.aspect) * Math.tan((camera.fov * Math.PI) / 360);
      const distance = radius * Math.sqrt(1 + 1 / narrow ** 2);
      camera.position.copy(controls.target).add(offset.setLength(Math.max(offset.length(), distance)));
    }
    controls.update();
    this.changed();
  }

  /** The picture as a PNG; null without WebGL. */
  picture(): Promise<Blob | null> {
    const { renderer } = this;
    if (!renderer) return Promise.resolve(null);
    renderer.render(this.scene, this.camera);
    return new Promise((resolve) => renderer.domElement.toBlob(resolve, "image/png"));
  }

  dispose(): void {
    this.disposed = true;
    this.resize.disconnect();
    this.canvas.removeEventListener("webglcontextlost", this.lose);
    this.darkness.removeEventListener("change", this.paint);
    this.controls.dispose();
    this.renderer?.dispose();
    this.renderer?.forceContextLoss(); // browsers have few contexts, and free them late by themselves
    this.canvas.remove();
    this.lost.remove();
  }

  private readonly lose = (event: Event): void => {
    event.preventDefault(); // otherwise the browser does not restore it
    this.canvas.style.visibility = "hidden";
    this.holder.append(this.lost);
  };

  private readonly restore = (): void => {
    this.canvas.style.visibility = "";
    this.lost.remove();
    this.changed();
  };

  private writePoint(): void {
    if (!this.pointed) return;
    const { x, y } = this.pointed.getWorldPosition(new Vector3()).project(this.camera);
    const { clientWidth: width, clientHeight: height } = this.holder;
    this.holder.dataset["tool"] = `${((0.5 + x / 2) * width).toFixed(1)},${((0.5 - y / 2) * height).toFixed(1)}`;
  }

  private readonly paint = (): void => {
    const theme = this.darkness.matches ? dark : light;
    this.scene.background = new Color(theme.background);
    if (this.grid) this.scene.remove(this.grid);
    this.grid?.dispose();
    const cell = 10 ** Math.round(Math.log10(this.size / 4));
    const cells = 2 * Math.ceil((1.5 * this.size) / cell);
    this.grid = new GridHelper(cells * cell, cells, theme.gridCentre, theme.grid);
    this.grid.rotation.x = Math.PI / 2;
    this.scene.add(this.grid);
    this.changed();
  };

  private fit(): void {
    const { clientWidth: width, clientHeight: height } = this.holder;
    if (width === 0 || height === 0) return;
    this.renderer?.setSize(width, height);
    const aspect = width / height;
    if (this.camera instanceof PerspectiveCamera) {
      this.camera.aspect = aspect;
    } else {
      const half = 1.15 * this.size * Math.max(1, 1 / aspect);
      this.camera.left = -half * aspect;
      this.camera.right = half * aspect;
      this.camera.top = half;
      this.camera.bottom = -half;
    }
    this.camera.updateProjectionMatrix();
    this.changed();
  }
}
