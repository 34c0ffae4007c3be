import {
  BoxGeometry,
  CapsuleGeometry,
  CylinderGeometry,
  PlaneGeometry,
  SphereGeometry,
  Vector3,
  type BufferGeometry,
} from "three";
import { ConvexGeometry } from "three/addons/geometries/ConvexGeometry.js";
import type { SceneShape } from "../../core/scene.js";

const least = 1e-4; // of the picture: a plate without thickness is seen
const round = 32; // sides of a cylinder

/** The surface of a shape about its own origin, m: grown by its padding, except hulls, whose padding is small. `size`: of the
 * picture, over which a half-space extends. */
export function geometryOf(shape: SceneShape, size: number): BufferGeometry {
  const { box, sphere, cylinder, capsule, convex_hull: hull, padding = 0 } = shape;
  const thick = (value: number): number => Math.max(value + 2 * padding, least * size);
  const radius = (value: number): number => Math.max(value + padding, least * size);
  if (box) {
    const [x = 0, y = 0, z = 0] = box.size;
    return new BoxGeometry(thick(x), thick(y), thick(z));
  }
  if (sphere) return new SphereGeometry(radius(sphere.radius), round, round / 2);
  if (cylinder) {
    const of = radius(cylinder.radius);
    return new CylinderGeometry(of, of, thick(cylinder.length), round).rotateX(Math.PI / 2); // about z
  }
  if (capsule)
    return new CapsuleGeometry(radius(capsule.radius), capsule.length, round / 4, round).rotateX(Math.PI / 2);
  if (hull) return hullOf(hull.vertices);
  return new PlaneGeometry(6 * size, 6 * size); // of a half-space: z = 0
}

/** The hull of points; a box around points that have none, which lie in a plane. */
function hullOf(vertices: number[][]): BufferGeometry {
  const points = vertices.map((vertex) => new Vector3(...vertex));
  try {
    return new ConvexGeometry(points);
  } catch {
    return new BoxGeometry();
  }
}
