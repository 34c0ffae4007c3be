import { poseNumbers, poseOfQuaternion, poseOfRpy } from "./pose.js";

/** A pose in a scene's file: metres and radians. */
export interface ScenePose {
  xyz?: number[];
  rpy?: number[];
  quaternion?: { qw: number; qx: number; qy: number; qz: number };
  matrix?: number[][];
}

/** A shape of docs/arm.schema.json: one of the bodies, posed in the world or in the frame of a link. */
export interface SceneShape {
  box?: { size: number[] };
  sphere?: { radius: number };
  cylinder?: { radius: number; length: number };
  capsule?: { radius: number; length: number };
  half_space?: object;
  convex_hull?: { vertices: number[][] };
  pose?: ScenePose;
  padding?: number;
  hull_of?: string;
}

/** Spheres of one radius, m, around points in the frame of `pose`. */
export interface PointCloud {
  radius: number;
  points?: number[][];
  pose?: ScenePose;
}

export interface SceneBody {
  name: string;
  shapes: SceneShape[];
  /** Beside the shapes. */
  point_cloud?: PointCloud;
  clearance?: number;
}

/** A scene of docs/scene.schema.json. */
export interface SceneDocument {
  obstacles: SceneBody[];
  allowed_pairs?: [string, string][];
  exempted_pairs?: [string, string][];
}

/** An arm with the shapes of its links, as a command reads it: an argument ARM, with the files that it names. */
export interface ArmWithShapes {
  argument: string;
  /** The last link of a URDF file; empty: the command's choice. */
  tip: string;
  files: Record<string, string | Uint8Array>;
}

/** The bodies of an arm, each in the frame of the link with this index; and the clearance to keep, m. */
export interface ArmBodies {
  bodies: SceneBody[];
  links: number[];
  clearance: number;
}

/** Two bodies with the least distance beyond their clearance, m: bounds of the distance, and the nearest points. */
export interface NearestPair {
  /** Indices of bodies, which count the bodies of the arm before the obstacles. */
  first: number;
  second: number;
  lower: number;
  upper: number;
  clearance: number;
  onFirst: number[];
  onSecond: number[];
}

/** Where a motion that a hand asks for has led. */
export interface GuardedStep {
  q: number[];
  /** The indices of the bodies that hold the arm back, as of a NearestPair; null: none do. */
  heldBy: [number, number] | null;
  /** Ask again from there: the arm is still on its way. */
  isOnItsWay: boolean;
  /** Whether the arm could stand at the goal. */
  isGoalFree: boolean;
}

/** A question about the arm among obstacles, and what it is answered by. The arm is asked for first; `clearance` 0 is the
 * default. `scene` is the text of a scene, `content` the one of a file of obstacles. */
export interface SceneAnswers {
  arm: ArmBodies;
  read: string;
  /** Of the pairs with obstacles, and of the pairs of links: the nearer one to its clearance first. */
  nearest: NearestPair[];
  /** The way that the clearance allows from one configuration towards another. `slides`: the tool slides along bodies;
   * else the arm stops. */
  guard: GuardedStep;
}
export type SceneTask =
  | { ask: "arm"; arm: ArmWithShapes; clearance: number }
  | { ask: "read"; name: string; content: string }
  | { ask: "nearest"; scene: string; q: number[] }
  | { ask: "guard"; scene: string; from: number[]; to: number[]; slides: boolean };

export const noObstacles: SceneDocument = { obstacles: [] };

/** An obstacle as a file has it: without shapes it is a point cloud. */
type WrittenBody = Omit<SceneBody, "shapes"> & Partial<Pick<SceneBody, "shapes">>;

/** The scene of a text that the core wrote; `noObstacles` where it is no scene. */
export function sceneOf(text: string): SceneDocument {
  if (text === "") return noObstacles;
  try {
    const read = JSON.parse(text) as Omit<SceneDocument, "obstacles"> & { obstacles: WrittenBody[] };
    const isBody = ({ shapes, point_cloud }: WrittenBody): boolean => Array.isArray(shapes ?? (point_cloud && []));
    if (!Array.isArray(read.obstacles) || !read.obstacles.every(isBody)) return noObstacles;
    return { ...read, obstacles: read.obstacles.map((body) => ({ ...body, shapes: body.shapes ?? [] })) };
  } catch {
    return noObstacles;
  }
}

/** The text of a scene, as a file has it; empty without obstacles and pairs. */
export function textOf(scene: SceneDocument, indent = 0): string {
  const { obstacles, allowed_pairs: allowed = [], exempted_pairs: exempted = [] } = scene;
  if (obstacles.length + allowed.length + exempted.length === 0) return "";
  const written = obstacles.map(({ shapes, ...body }): WrittenBody => (shapes.length > 0 ? { ...body, shapes } : body));
  return JSON.stringify({ ...scene, obstacles: written }, null, indent);
}

/** The scene without the pairs that may touch of which a body is not among `links` and obstacles, which commands refuse;
 * and these pairs. */
export function withKnownPairs(
  scene: SceneDocument,
  links: string[],
): { scene: SceneDocument; left: [string, string][] } {
  const names = new Set([...links, ...scene.obstacles.map(({ name }) => name)]);
  const isKnown = (pair: [string, string]): boolean => pair.every((name) => names.has(name));
  const { allowed_pairs: allowed = [] } = scene;
  const left = allowed.filter((pair) => !isKnown(pair));
  return { scene: left.length === 0 ? scene : { ...scene, allowed_pairs: allowed.filter(isKnown) }, left };
}

/** The pose of a shape as a column-major 4 x 4 matrix. */
export function poseOfShape({ pose = {} }: Pick<SceneShape, "pose">): number[] {
  const { xyz = [0, 0, 0], rpy = [0, 0, 0], quaternion, matrix } = pose;
  if (matrix) return [0, 1, 2, 3].flatMap((k) => matrix.map((row) => row[k] ?? 0));
  if (quaternion) return poseOfQuaternion([...xyz, quaternion.qw, quaternion.qx, quaternion.qy, quaternion.qz]);
  return poseOfRpy([...xyz, ...rpy]);
}

/** Where an obstacle stands: the pose of its first shape, or of its points. */
export function poseOfBody({ shapes, point_cloud: cloud }: SceneBody): number[] {
  return poseOfShape(shapes[0] ?? cloud ?? {});
}

/** A point in an obstacle: where its first shape stands, or the mean of its points. */
export function middleOfBody(body: SceneBody): number[] {
  const pose = poseOfBody(body);
  const points = body.shapes.length > 0 ? [] : (body.point_cloud?.points ?? []);
  if (points.length === 0) return pose.slice(12, 15);
  const mean = [0, 1, 2].map((k) => points.reduce((sum, point) => sum + (point[k] ?? 0), 0) / points.length);
  return product(pose, [1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1, 0, ...mean, 1]).slice(12, 15);
}

/** The product of two column-major 4 x 4 matrices. */
function product(a: number[], b: number[]): number[] {
  return Array.from({ length: 16 }, (_, i) =>
    [0, 1, 2, 3].reduce((sum, k) => sum + (a[4 * k + (i % 4)] ?? 0) * (b[i - (i % 4) + k] ?? 0), 0),
  );
}

/** The inverse of a rigid motion. */
function inverse(m: number[]): number[] {
  const at = (i: number): number => m[i] ?? 0;
  const back = (k: number): number => -(at(4 * k) * at(12) + at(4 * k + 1) * at(13) + at(4 * k + 2) * at(14));
  return [at(0), at(4), at(8), 0, at(1), at(5), at(9), 0, at(2), at(6), at(10), 0, back(0), back(1), back(2), 1];
}

/** A pose in numbers that are short to read: tenths of a millimetre, and 1e-5 rad. */
export function roundedPose(pose: number[]): ScenePose {
  const { position, rpy } = poseNumbers(pose);
  const short = (value: number, digits: number): number => Number(value.toFixed(digits)) + 0;
  const turns = rpy.map((value) => short(value, 5));
  const xyz = position.map((value) => short(value, 4));
  return turns.every((value) => value === 0) ? { xyz } : { xyz, rpy: turns };
}

/** An obstacle that is moved as a whole, its points too, to where poseOfBody() is `to`. */
export function movedBody(body: SceneBody, to: ScenePose): SceneBody {
  const { shapes, point_cloud: cloud } = body;
  const shift = product(poseOfShape({ pose: to }), inverse(poseOfBody(body)));
  const moved = <T extends Pick<SceneShape, "pose">>(part: T): T => {
    const { position, rpy } = poseNumbers(product(shift, poseOfShape(part)));
    return { ...part, pose: { xyz: position, rpy } };
  };
  return {
    ...body,
    shapes: shapes.map((shape, i) => (i === 0 ? { ...shape, pose: to } : moved(shape))),
    ...(cloud && { point_cloud: shapes.length === 0 ? { ...cloud, pose: to } : moved(cloud) }),
  };
}

/** A name that no other body has: "box", "box 2". */
export function freeName(kind: string, taken: string[]): string {
  for (let i = 1; ; ++i) {
    const name = i === 1 ? kind : `${kind} ${i}`;
    if (!taken.includes(name)) return name;
  }
}

/** The scene without an obstacle, and without the pairs that name it. */
export function withoutBody(scene: SceneDocument, name: string): SceneDocument {
  const others = (pairs?: [string, string][]): [string, string][] | undefined =>
    pairs?.filter((pair) => !pair.includes(name));
  return withPairs(
    { ...scene, obstacles: scene.obstacles.filter((one) => one.name !== name) },
    others(scene.allowed_pairs),
    others(scene.exempted_pairs),
  );
}

/** The scene in which an obstacle has another name. */
export function renamed(scene: SceneDocument, from: string, to: string): SceneDocument {
  const other = (name: string): string => (name === from ? to : name);
  const named = (pairs?: [string, string][]): [string, string][] | undefined =>
    pairs?.map(([a, b]): [string, string] => [other(a), other(b)]);
  const obstacles = scene.obstacles.map((one) => ({ ...one, name: other(one.name) }));
  return withPairs({ ...scene, obstacles }, named(scene.allowed_pairs), named(scene.exempted_pairs));
}

function withPairs(
  scene: SceneDocument,
  allowed: [string, string][] | undefined,
  exempted: [string, string][] | undefined,
): SceneDocument {
  return {
    ...scene,
    ...(allowed && { allowed_pairs: allowed }),
    ...(exempted && { exempted_pairs: exempted }),
  };
}
