import { Vector3 } from "three";
import { expect, test } from "vitest";
import { eigen } from "../src/core/symmetric_eigen.js";
import { selfMotion } from "../src/page/self_motion.js";
import { loadCore, random } from "./native.js";

const seed = Number(process.env["BEELINE_SEED"] ?? 20240229);
console.log(`BEELINE_SEED=${seed}`);
const next = random(seed);

test("eigenvectors are orthonormal, and the matrix times each is its eigenvalue times it", () => {
  for (let trial = 0; trial < 200; ++trial) {
    const rank = 1 + (trial % 3);
    const columns = Array.from({ length: rank }, () => new Vector3(next() - 0.5, next() - 0.5, next() - 0.5));
    const a = [0, 1, 2].map((i) =>
      [0, 1, 2].map((k) => columns.reduce((sum, c) => sum + c.getComponent(i) * c.getComponent(k), 0)),
    );
    const { values, vectors } = eigen(a);
    const all = vectors.map(([x = 0, y = 0, z = 0]) => new Vector3(x, y, z));
    all.forEach((v, i) => {
      all.forEach((w, k) => expect(Math.abs(v.dot(w) - (i === k ? 1 : 0))).toBeLessThan(1e-12));
      const product = new Vector3(...a.map(([x = 0, y = 0, z = 0]) => v.dot(new Vector3(x, y, z))));
      expect(product.sub(v.clone().multiplyScalar(values[i] ?? 0)).length()).toBeLessThan(1e-12);
    });
  }
});

test("the self-motion of a redundant arm leaves the tool at rest", async () => {
  const core = await loadCore();
  for (const name of ["panda", "iiwa14"]) {
    const arm = core.arm(name);
    for (let trial = 0; trial < 20; ++trial) {
      const q = Array.from({ length: arm.dof }, () => 2 * next() - 1);
      const jacobian = arm.jacobian(q);
      const direction = selfMotion(jacobian, arm.dof);
      expect(direction).not.toBeNull();
      expect(Math.hypot(...(direction ?? []))).toBeCloseTo(1, 12);
      for (let i = 0; i < 6; ++i) {
        const rate = (direction ?? []).reduce((sum, value, k) => sum + value * (jacobian[6 * k + i] ?? 0), 0);
        expect(Math.abs(rate)).toBeLessThan(1e-12);
      }
    }
    arm.release();
  }
  const six = core.arm("puma560");
  expect(selfMotion(six.jacobian([0.3, -0.5, 0.7, 0.2, 0.9, 0.1]), 6)).toBeNull();
});
