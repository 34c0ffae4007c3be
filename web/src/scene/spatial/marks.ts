import {
  ArrowHelper,
  BufferGeometry,
  CanvasTexture,
  Color,
  GreaterDepth,
  Group,
  Line,
  LineBasicMaterial,
  LineDashedMaterial,
  Matrix4,
  type Material,
  Points,
  PointsMaterial,
  Vector3,
} from "three";
import { jointColour, resolved } from "../colours.js";
import type { Trail } from "../picture.js";

const axisColours = ["--axis-x", "--axis-y", "--axis-z"];

/** The axes of a frame, thin: x red, y green, z blue. Drawn over the links, most of which have their frames inside. */
export function triad(length: number): Group {
  const group = new Group();
  const axes = [new Vector3(1, 0, 0), new Vector3(0, 1, 0), new Vector3(0, 0, 1)];
  axes.forEach((axis, i) => {
    const colour = new Color(resolved(axisColours[i] ?? ""));
    const arrow = new ArrowHelper(axis, new Vector3(), length, colour, 0.2 * length, 0.09 * length);
    for (const part of [arrow.line, arrow.cone]) {
      (part.material as Material).depthTest = false;
      part.renderOrder = 1;
    }
    group.add(arrow);
  });
  group.matrixAutoUpdate = false;
  return group;
}

/** Puts a group at a pose: a column-major 4 x 4 matrix. */
export function putAt(group: Group, pose: ArrayLike<number>): void {
  group.matrix.copy(new Matrix4().fromArray(Array.from(pose)));
  group.matrixWorldNeedsUpdate = true;
}

/** Arrows from one point, the columns of a Jacobian, each in the colour of its joint. */
export class Arrows extends Group {
  /** `shortest`: an arrow that is shorter is not shown, metres. */
  constructor(
    count: number,
    private readonly shortest: number,
  ) {
    super();
    for (let k = 0; k < count; ++k)
      this.add(new ArrowHelper(new Vector3(0, 0, 1), new Vector3(), 1, new Color(resolved(jointColour(k)))));
  }

  place(origin: Vector3, vectors: Vector3[]): void {
    (this.children as ArrowHelper[]).forEach((arrow, i) => {
      const vector = vectors[i] ?? new Vector3();
      const length = vector.length();
      arrow.visible = length >= this.shortest;
      if (!arrow.visible) return;
      const head = Math.min(0.3 * length, 4 * this.shortest);
      arrow.position.copy(origin);
      arrow.setDirection(vector.clone().normalize());
      arrow.setLength(length, head, 0.5 * head);
    });
  }

  override dispose(): this {
    for (const arrow of this.children as ArrowHelper[]) arrow.dispose();
    return this.removeFromParent();
  }
}

/** A white disc, which makes points round. */
export function disc(): CanvasTexture {
  const canvas = document.createElement("canvas");
  canvas.width = canvas.height = 32;
  const context = canvas.getContext("2d");
  if (context) {
    context.fillStyle = "#fff";
    context.arc(16, 16, 16, 0, 2 * Math.PI);
    context.fill();
  }
  return new CanvasTexture(canvas);
}

/** The same material for what is behind the arm, through which it is seen faintly. */
function veiled<M extends Material>(material: M): M {
  const behind = material.clone() as M;
  behind.depthFunc = GreaterDepth;
  behind.depthWrite = false;
  behind.transparent = true; // drawn after the arm
  behind.opacity = 0.55;
  return behind;
}

/** A path of the tool with a dot at each step: dots close together are slow. Removed from the scene, it frees its
 * memory on the graphics card; added again, it takes it again. */
export function trail({ points, tone, dots, every = 1 }: Trail, size: number): Group {
  const places = points.map((point) => new Vector3(...point));
  const geometry = new BufferGeometry().setFromPoints(places);
  const stepped = new BufferGeometry().setFromPoints(places.filter((_, i) => i % every === 0));
  const color = new Color(resolved(`--trail-${tone}`));
  const dash = 0.02 * size;
  const line =
    tone === "preview"
      ? new LineDashedMaterial({ color, dashSize: dash, gapSize: dash })
      : new LineBasicMaterial({ color });
  const steps = new PointsMaterial({ color, size: 6, sizeAttenuation: false, map: disc(), alphaTest: 0.5 });
  const [veiledLine, veiledSteps] = [veiled(line), veiled(steps)];
  const group = new Group();
  const path = new Line(geometry, line);
  if (tone === "preview") path.computeLineDistances();
  group.add(path, new Line(geometry, veiledLine));
  if (dots) group.add(new Points(stepped, steps), new Points(stepped, veiledSteps));
  group.addEventListener("removed", () => {
    steps.map?.dispose();
    for (const part of [geometry, stepped, line, steps, veiledLine, veiledSteps]) part.dispose();
  });
  return group;
}
