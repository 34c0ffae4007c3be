import { BufferAttribute, BufferGeometry, Color, DoubleSide, Mesh, MeshStandardMaterial, SRGBColorSpace } from "three";
import type { ReachSurface } from "../../core/reach.js";

/** A closed surface around the arm, translucent: its back is drawn before its front, and both after the arm. */
export class ReachMesh extends Mesh<BufferGeometry, MeshStandardMaterial> {
  constructor() {
    const material = new MeshStandardMaterial({
      transparent: true,
      opacity: 0.35,
      depthWrite: false,
      side: DoubleSide,
      roughness: 0.6,
    });
    super(new BufferGeometry(), material);
    this.renderOrder = 1;
  }

  /** `colour`: red, green and blue, 0 to 255. */
  show({ vertices, triangles }: ReachSurface, [red, green, blue]: [number, number, number]): void {
    this.geometry.dispose();
    this.geometry = new BufferGeometry();
    this.geometry.setAttribute("position", new BufferAttribute(vertices, 3));
    this.geometry.setIndex(new BufferAttribute(triangles, 1));
    this.geometry.computeVertexNormals();
    this.material.color = new Color().setRGB(red / 255, green / 255, blue / 255, SRGBColorSpace);
  }

  override dispose(): this {
    this.geometry.dispose();
    this.material.dispose();
    return this.removeFromParent();
  }
}
