import { Matrix4, Mesh, MeshStandardMaterial, SphereGeometry, Vector3 } from "three";

/** Eigenvalues and orthonormal eigenvectors of a symmetric 3 x 3 matrix, by Jacobi's rotations. */
export function eigen(symmetric: number[][]): { values: number[]; vectors: number[][] } {
  const a = symmetric.map((row) => [...row]);
  const v = [
    [1, 0, 0],
    [0, 1, 0],
    [0, 0, 1],
  ];
  const at = (m: number[][], i: number, k: number): number => m[i]?.[k] ?? 0;
  const rounds = 12; // convergence is quadratic
  for (let round = 0; round < rounds; ++round) {
    for (const [p, q] of [
      [0, 1],
      [0, 2],
      [1, 2],
    ] as const) {
      const angle = 0.5 * Math.atan2(2 * at(a, p, q), at(a, q, q) - at(a, p, p));
      const [c, s] = [Math.cos(angle), Math.sin(angle)];
      for (const m of [a, v]) {
        for (const row of m)
          [row[p], row[q]] = [c * (row[p] ?? 0) - s * (row[q] ?? 0), s * (row[p] ?? 0) + c * (row[q] ?? 0)];
      }
      const [above, below] = [a[p] as number[], a[q] as number[]];
      for (let k = 0; k < 3; ++k) {
        [above[k], below[k]] = [c * (above[k] ?? 0) - s * (below[k] ?? 0), s * (above[k] ?? 0) + c * (below[k] ?? 0)];
      }
    }
  }
  return { values: [0, 1, 2].map((i) => at(a, i, i)), vectors: [0, 1, 2].map((k) => v.map((row) => row[k] ?? 0)) };
}

/** The velocity ellipsoid at a point: the velocities J dq of all joint velocities with |dq| = 1, metres a second drawn
 * as `scale` metres (Lynch & Park, section 5.4). `columns`: the translational rows of the Jacobian, by columns. */
export class VelocityEllipsoid extends Mesh<SphereGeometry, MeshStandardMaterial> {
  constructor(private readonly flattest: number) {
    const material = new MeshStandardMaterial({ color: 0x6d4fc2, transparent: true, opacity: 0.3, depthWrite: false });
    super(new SphereGeometry(1, 40, 24), material);
    this.matrixAutoUpdate = false;
  }

  place(point: Vector3, columns: Vector3[], scale: number): void {
    const product = [0, 1, 2].map((i) =>
      [0, 1, 2].map((k) => columns.reduce((sum, c) => sum + c.getComponent(i) * c.getComponent(k), 0)),
    );
    const { values, vectors } = eigen(product);
    const axes = vectors.map(([x = 0, y = 0, z = 0], i) => {
      const length = Math.max(scale * Math.sqrt(Math.max(values[i] ?? 0, 0)), this.flattest);
      return new Vector3(x, y, z).multiplyScalar(length);
    });
    this.matrix.copy(
      new Matrix4().makeBasis(axes[0] as Vector3, axes[1] as Vector3, axes[2] as Vector3).setPosition(point),
    );
    this.matrixWorldNeedsUpdate = true;
  }

  override dispose(): this {
    this.geometry.dispose();
    this.material.dispose();
    return this.removeFromParent();
  }
}
