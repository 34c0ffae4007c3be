import { Raycaster, ShaderLib, Vector3, type PointsMaterial } from "three";
import { expect, test } from "vitest";
import { middleOfBody, movedBody, type SceneBody } from "../src/core/scene.js";
import { Cloud } from "../src/scene/spatial/cloud.js";

const points = [
  [0, 0, 1],
  [0, 0, 2],
  [1, 0, 1],
];

test("a ray hits the spheres of a cloud, and no others", () => {
  const cloud = new Cloud({ radius: 0.1, points });
  const ray = new Raycaster();
  const hits = (x: number): number[] => {
    ray.set(new Vector3(x, 0, 5), new Vector3(0, 0, -1));
    return ray.intersectObject(cloud).map(({ index }) => index ?? -1);
  };
  const before = ray.params.Points.threshold;
  expect(hits(0.09)).toEqual([1, 0]); // the nearer one first
  expect(hits(0.11)).toEqual([]);
  expect(hits(1)).toEqual([2]);
  expect(ray.params.Points.threshold).toBe(before);
  expect(cloud.geometry.getAttribute("position").count).toBe(3);
});

test("the size of a point is the diameter of its sphere, by the perspective of the camera", () => {
  const material: PointsMaterial = new Cloud({ radius: 0.1, points }).material;
  expect([material.size, material.sizeAttenuation]).toEqual([0.2, true]);
  const { vertexShader, fragmentShader } = ShaderLib.points;
  const shader = { vertexShader, fragmentShader };
  material.onBeforeCompile(shader as never, null as never);
  expect(shader.vertexShader).toContain("size * projectionMatrix[1][1]");
  expect(shader.fragmentShader).toContain("discard");
});

test("the middle of a cloud is the mean of its points, where they stand", () => {
  const scan: SceneBody = { name: "scan", shapes: [], point_cloud: { radius: 0.1, points } };
  const near = (body: SceneBody, at: number[]): void =>
    middleOfBody(body).forEach((value, k) => expect(value).toBeCloseTo(at[k] ?? NaN, 9));
  near(scan, [1 / 3, 0, 4 / 3]);
  near(movedBody(scan, { xyz: [1, 2, 3], rpy: [0, 0, Math.PI / 2] }), [1, 2 + 1 / 3, 3 + 4 / 3]);
  near({ ...scan, shapes: [{ sphere: { radius: 1 }, pose: { xyz: [5, 6, 7] } }] }, [5, 6, 7]);
  near({ name: "empty", shapes: [], point_cloud: { radius: 1, pose: { xyz: [1, 1, 1] } } }, [1, 1, 1]);
});
