import {
  Box3,
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
const marker = 4e-3; // of the picture: a hull of points on a line is seen
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
  if (hull) return hullOf(hull.vertices, marker * size);
  return new PlaneGeometry(6 * size, 6 * size); // of a half-space: z = 0
}

/** The hull of points. Points on a line, or in one place, have none: their box is drawn, at least `thin` thick. */
function hullOf(vertices: number[][], thin: number): BufferGeometry {
  const points = vertices.map((vertex) => new Vector3(...vertex));
  if (points.length > 3 && spanArea(points) > thin * thin) {
    try {
      return new ConvexGeometry(points);
    } catch {
      // all in a plane
    }
  }
  const box = new Box3().setFromPoints(points);
  const [size, centre] = [box.getSize(new Vector3()), box.getCenter(new Vector3())];
  const thick = (value: number): number => Math.max(value, thin);
  return new BoxGeometry(thick(size.x), thick(size.y), thick(size.z)).translate(centre.x, centre.y, centre.z);
}

/** Twice the area of a large triangle of points, m²: 0 of points on a line. */
function spanArea([first = new Vector3(), ...others]: Vector3[]): number {
  const arms = others.map((point) => point.clone().sub(first));
  const longest = arms.reduce((a, b) => (b.lengthSq() > a.lengthSq() ? b : a), new Vector3());
  return Math.max(0, ...arms.map((arm) => arm.clone().cross(longest).length()));
}
