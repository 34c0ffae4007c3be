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

export const axisColours = [0xd0312d, 0x2e8b3d, 0x2b5fc7]; // x, y, z

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
export function arrows(origin: Vector3, vectors: Vector3[], headless: number): Group {
  const group = new Group();
  vectors.forEach((vector, i) => {
    const length = vector.length();
    if (length < headless) return;
    const head = Math.min(0.3 * length, 4 * headless);
    const arrow = new ArrowHelper(vector.clone().normalize(), origin, length, axisColours[i % 3], head, 0.5 * head);
    group.add(arrow);
  });
  return group;
}

/** A path of the tool with a dot at each step: dots close together are slow. */
export function trail(points: Vector3[], colour: number): Group {
  const geometry = new BufferGeometry().setFromPoints(points);
  const dots = new PointsMaterial({ color: colour, size: 6, sizeAttenuation: false });
  const group = new Group();
  group.add(new Line(geometry, new LineBasicMaterial({ color: colour })), new Points(geometry, dots));
  return group;
}
