import {
  ArrowHelper,
  BufferGeometry,
  Group,
  Line,
  LineBasicMaterial,
  Matrix4,
  Points,
  PointsMaterial,
  Vector3,
} from "three";

export const blue = 0x2b5fc7;
export const axisColours = [0xd0312d, 0x2e8b3d, blue]; // x, y, z

/** The axes of a frame: x red, y green, z blue. */
export function triad(length: number): Group {
  const group = new Group();
  const axes = [new Vector3(1, 0, 0), new Vector3(0, 1, 0), new Vector3(0, 0, 1)];
  axes.forEach((axis, i) => {
    group.add(new ArrowHelper(axis, new Vector3(), length, axisColours[i], 0.25 * length, 0.12 * length));
  });
  group.matrixAutoUpdate = false;
  return group;
}

/** Puts a group at a pose: a column-major 4 x 4 matrix. */
export function putAt(group: Group, pose: ArrayLike<number>): void {
  group.matrix.copy(new Matrix4().fromArray(Array.from(pose)));
  group.matrixWorldNeedsUpdate = true;
}

/** Arrows from one point, such as the columns of a Jacobian: column k in colour k of red, green, blue. */
export class Arrows extends Group {
  /** `shortest`: an arrow that is shorter is not shown, metres. */
  constructor(
    count: number,
    private readonly shortest: number,
  ) {
    super();
    for (let i = 0; i < count; ++i)
      this.add(new ArrowHelper(new Vector3(0, 0, 1), new Vector3(), 1, axisColours[i % 3]));
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

/** A path of the tool with a dot at each step: dots close together are slow. Removed from the scene, it frees its
 * memory on the graphics card; added again, it takes it again. */
export function trail(points: Vector3[], colour: number): Group {
  const geometry = new BufferGeometry().setFromPoints(points);
  const line = new LineBasicMaterial({ color: colour });
  const dots = new PointsMaterial({ color: colour, size: 6, sizeAttenuation: false });
  const group = new Group();
  group.add(new Line(geometry, line), new Points(geometry, dots));
  group.addEventListener("removed", () => {
    for (const part of [geometry, line, dots]) part.dispose();
  });
  return group;
}
