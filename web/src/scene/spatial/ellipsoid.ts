import { Color, Matrix4, Mesh, MeshLambertMaterial, SphereGeometry, Vector3 } from "three";
import { eigen } from "../../core/symmetric_eigen.js";
import { resolved } from "../colours.js";

/** The velocity ellipsoid at a point: the velocities J dq of all joint velocities with |dq| = 1, metres a second drawn
 * as `scale` metres (Lynch & Park, section 5.4). `columns`: the translational rows of the Jacobian, by columns. */
export class VelocityEllipsoid extends Mesh<SphereGeometry, MeshLambertMaterial> {
  constructor(private readonly flattest: number) {
    const material = new MeshLambertMaterial({
      color: new Color(resolved("--ellipsoid")),
      transparent: true,
      opacity: 0.3,
      depthWrite: false,
    });
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
