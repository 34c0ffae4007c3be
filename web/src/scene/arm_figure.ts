import {
  BoxGeometry,
  CylinderGeometry,
  Group,
  Mesh,
  MeshStandardMaterial,
  Quaternion,
  SphereGeometry,
  Vector3,
  type BufferGeometry,
} from "three";

/** A joint of the arm's centre line, as `beeline_skeleton` writes it: metres, in the world. */
export interface SkeletonJoint {
  kind: "revolute" | "prismatic" | "helical";
  direction: Vector3;
  enter: Vector3;
  leave: Vector3;
  centre: Vector3;
}

export interface Skeleton {
  base: Vector3;
  joints: SkeletonJoint[];
  tool: Vector3;
}

const along = new Vector3(0, 1, 0); // the axis of three's cylinders
const jointColours = { revolute: 0xf4f6f8, prismatic: 0xe9d8b4, helical: 0xd9c9e8 };

/** An arm as tubes along its centre line and a symbol for each joint: a cylinder for a revolute or helical one, a box
 * for a prismatic one. */
export class ArmFigure extends Group {
  private readonly tubes: Mesh[] = [];
  private covered: boolean[] = [];
  private readonly bends: Mesh[] = [];
  private readonly symbols: Mesh[] = [];

  /** `size`: the arm's reach, metres; `opacity` below 1 for ghosts. */
  constructor(
    private readonly joints: SkeletonJoint["kind"][],
    size: number,
    colour = 0x8fa9c4,
    opacity = 1,
  ) {
    super();
    const radius = 0.022 * size;
    const material = (color: number): MeshStandardMaterial =>
      new MeshStandardMaterial({
        color,
        opacity,
        transparent: opacity < 1,
        roughness: 0.55,
        depthWrite: opacity === 1,
      });
    const link = material(colour);
    const tube = new CylinderGeometry(radius, radius, 1, 24);
    const bend = new SphereGeometry(radius, 20, 12);
    const barrel = new CylinderGeometry(1.7 * radius, 1.7 * radius, 4.2 * radius, 32);
    const slide = new BoxGeometry(3.2 * radius, 4.2 * radius, 3.2 * radius);
    for (let i = 0; i < 2 * joints.length + 1; ++i) this.part(this.tubes, tube, link);
    for (let i = 0; i < 2 * joints.length + 1; ++i) this.part(this.bends, bend, link);
    for (const kind of joints)
      this.part(this.symbols, kind === "prismatic" ? slide : barrel, material(jointColours[kind]));
  }

  /** Hides the shapes of links that have meshes: link 0 is the base, link i moves with joint i. */
  cover(links: ReadonlySet<number>): void {
    const both = (joint: number): boolean => links.has(joint) && links.has(joint + 1);
    this.symbols.forEach((symbol, i) => (symbol.visible = !both(i)));
    // Tube 2 i is of link i, tube 2 i + 1 along the axis from link i to link i + 1; a bend ends each.
    const hidden = (i: number): boolean => (i % 2 === 0 ? links.has(i / 2) : both((i - 1) / 2));
    this.covered = this.tubes.map((_, i) => hidden(i));
    this.bends.forEach((bend, i) => (bend.visible = !(hidden(i) && (i + 1 === this.bends.length || hidden(i + 1)))));
    this.tubes.forEach((tube, i) => (tube.visible &&= !this.covered[i]));
  }

  /** Shows the arm at a configuration. */
  place(skeleton: Skeleton): void {
    const line = [skeleton.base, ...skeleton.joints.flatMap((joint) => [joint.enter, joint.leave]), skeleton.tool];
    this.tubes.forEach((tube, i) => {
      stretch(tube, line[i] as Vector3, line[i + 1] as Vector3);
      if (this.covered[i]) tube.visible = false;
    });
    this.bends.forEach((bend, i) => bend.position.copy(line[i + 1] as Vector3));
    this.symbols.forEach((symbol, i) => {
      const joint = skeleton.joints[i] as SkeletonJoint;
      symbol.position.copy(joint.centre);
      symbol.quaternion.copy(new Quaternion().setFromUnitVectors(along, joint.direction));
    });
  }

  override dispose(): this {
    for (const mesh of [...this.tubes, ...this.bends, ...this.symbols]) {
      mesh.geometry.dispose();
      (mesh.material as MeshStandardMaterial).dispose();
    }
    this.removeFromParent();
    return this;
  }

  private part(list: Mesh[], geometry: BufferGeometry, material: MeshStandardMaterial): void {
    const mesh = new Mesh(geometry, material);
    list.push(mesh);
    this.add(mesh);
  }

  get kinds(): SkeletonJoint["kind"][] {
    return this.joints;
  }
}

/** Lays a cylinder of unit height from a to b. */
function stretch(mesh: Mesh, a: Vector3, b: Vector3): void {
  const segment = b.clone().sub(a);
  const length = segment.length();
  mesh.visible = length > 1e-12;
  if (!mesh.visible) return;
  mesh.position.copy(a).addScaledVector(segment, 0.5);
  mesh.quaternion.copy(new Quaternion().setFromUnitVectors(along, segment.divideScalar(length)));
  mesh.scale.set(1, length, 1);
}
