import {
  BackSide,
  BoxGeometry,
  Color,
  CustomBlending,
  CylinderGeometry,
  Group,
  Mesh,
  MeshBasicMaterial,
  MeshLambertMaterial,
  NotEqualStencilFunc,
  OneFactor,
  Quaternion,
  ReplaceStencilOp,
  SphereGeometry,
  Vector3,
  type BufferGeometry,
  type Material,
} from "three";
import type { Skeleton } from "../../core/types.js";
import { jointColour, resolved } from "../colours.js";
import { centreLine } from "../picture.js";
import { castShadow } from "./floor_shadow.js";

type Kind = Skeleton["joints"][number]["kind"];

/** What is drawn first: the ground, the shadow of the arm, ghosts; then, at 0, the arm. */
export const drawOrder = { ground: -3, shadow: -2, ghosts: -1 };

const along = new Vector3(0, 1, 0); // the axis of three's cylinders
const ghostOpacity = { fill: 0.25, rim: 0.75 };
/** Of the joint's colour in a link that the mouse points at. */
export const lightness = 0.5;

/** The sizes of an arm with a reach and a number of joints, m. */
function sizesOf(reach: number, joints: number): { tube: number; rim: number } {
  const slimmer = Math.min(1, Math.max(0.15, Math.sqrt(10 / joints)));
  return { tube: 0.02 * reach * slimmer, rim: 0.0042 * reach * slimmer };
}

/** A material of a ghost: each pixel is coloured once for all shapes of the ghost (`index` counts ghosts from 0), so that
 * they are one silhouette. It is drawn before the arm and writes no depth, so that it never covers the arm. */
function ghostMaterial(index: number, opacity: number): MeshBasicMaterial {
  return new MeshBasicMaterial({
    opacity,
    blending: CustomBlending, // blends, but is drawn with what is opaque, in the order of `renderOrder`
    blendSrcAlpha: OneFactor, // the picture stays opaque
    depthWrite: false,
    stencilWrite: true,
    stencilFunc: NotEqualStencilFunc,
    stencilRef: index + 1,
    stencilZPass: ReplaceStencilOp,
  });
}

/** An arm as outlined tubes along its centre line and a symbol for each joint, with a band in the colour of the joint: a
 * cylinder for a revolute or helical one, a box for a prismatic one. The arm itself stands on a base and casts a shadow; a
 * ghost is a pale silhouette behind it. */
export class ArmFigure extends Group {
  private readonly tubes: Group[] = [];
  private readonly bends: Group[] = [];
  private readonly symbols: Group[] = [];
  private readonly base = new Group();
  private readonly link: MeshLambertMaterial | MeshBasicMaterial;
  private readonly white: MeshLambertMaterial | MeshBasicMaterial;
  private readonly foot = new MeshLambertMaterial();
  private readonly ink: MeshBasicMaterial;
  private readonly bands: (MeshLambertMaterial | MeshBasicMaterial)[];
  /** Of the link that the mouse points at. */
  private readonly glow = new MeshLambertMaterial();
  private lit: number | null = null;
  private covered: boolean[] = [];
  /** Of the tubes, m. */
  readonly radius: number;
  /** Of the outlines, m. */
  readonly rim: number;

  /** `size`: the arm's reach, metres; `ghost`: its colour, a CSS variable, and its number among the ghosts. */
  constructor(
    readonly kinds: Kind[],
    size: number,
    private readonly ghost: { tone: string; readonly index: number } | null = null,
  ) {
    super();
    if (ghost) {
      this.link = this.white = ghostMaterial(ghost.index, ghostOpacity.fill);
      this.bands = kinds.map(() => this.link);
      this.ink = ghostMaterial(ghost.index, ghostOpacity.rim);
    } else {
      this.link = new MeshLambertMaterial();
      this.white = new MeshLambertMaterial();
      this.bands = kinds.map(() => new MeshLambertMaterial());
      this.ink = new MeshBasicMaterial({ side: BackSide });
    }
    const { tube: radius, rim } = sizesOf(size, kinds.length);
    [this.radius, this.rim] = [radius, rim];
    const outlined = (shape: (grown: number) => BufferGeometry, material: Material, ...more: Mesh[]): (() => Group) => {
      const [inner, outer] = [shape(0), shape(rim)];
      return () =>
        new Group().add(new Mesh(inner, material), new Mesh(outer, this.ink), ...more.map((part) => part.clone()));
    };
    const tubeOf = outlined((d) => new CylinderGeometry(radius + d, radius + d, 1, 20, 1, true), this.link);
    const bendOf = outlined((d) => new SphereGeometry(radius + d, 20, 12), this.link);
    this.fill(this.tubes, 2 * kinds.length + 1, tubeOf);
    this.fill(this.bends, 2 * kinds.length + 2, bendOf);
    const barrelOf = outlined(
      (d) => new CylinderGeometry(1.65 * radius + d, 1.65 * radius + d, 4 * radius + 2 * d, 28),
      this.white,
    );
    const boxOf = outlined(
      (d) => new BoxGeometry(3 * radius + 2 * d, 4 * radius + 2 * d, 3 * radius + 2 * d),
      this.white,
    );
    const ring = new CylinderGeometry(1.72 * radius, 1.72 * radius, 1.3 * radius, 28);
    const collar = new BoxGeometry(3.14 * radius, 1.3 * radius, 3.14 * radius);
    kinds.forEach((kind, k) => {
      const symbol = kind === "prismatic" ? boxOf() : barrelOf();
      symbol.add(new Mesh(kind === "prismatic" ? collar : ring, this.bands[k]));
      symbol.userData["joint"] = k;
      this.symbols.push(symbol);
      this.add(symbol);
    });
    this.tubes.forEach((part, i) => (part.userData["joint"] = jointAt(i)));
    if (ghost === null) this.stand(radius, rim);
    else this.order(ghost.index);
    this.paint();
  }

  /** Draws a ghost after the ground and before the arm: its inside, then the rim around the whole of it. */
  private order(index: number): void {
    this.traverse((part) => {
      if (part instanceof Mesh)
        part.renderOrder = drawOrder.ghosts + 0.01 * index + (part.material === this.ink ? 0.005 : 0);
    });
  }

  private stand(radius: number, rim: number): void {
    const disc = (d: number): BufferGeometry =>
      new CylinderGeometry(4.4 * radius + d, 4.4 * radius + d, this.foundation + 2 * d, 40);
    this.base.add(new Mesh(disc(0), this.foot), new Mesh(disc(rim), this.ink));
    for (const part of this.base.children) part.position.y = -this.foundation / 2;
    for (const part of [...this.tubes, ...this.bends]) castShadow(part.children[0] as Mesh);
    this.add(this.base);
  }

  /** The height of the disc below the arm, m. */
  get foundation(): number {
    return 1.3 * this.radius;
  }

  /** Whether the arm stands on its disc, which a mesh may replace. */
  get stands(): boolean {
    return this.base.visible;
  }

  /** Takes the colours of the page, light or dark. */
  paint(): void {
    const colour = (name: string): Color => new Color(resolved(name));
    if (this.ghost) {
      this.link.color = this.ink.color = colour(`${this.ghost.tone}-rim`);
      return;
    }
    this.link.color = colour("--steel");
    this.foot.color = colour("--foot");
    this.white.color = colour("--joint-fill");
    this.ink.color = colour("--ink");
    this.bands.forEach((band, k) => (band.color = colour(jointColour(k))));
    this.glow.color = this.link.color.clone().lerp(colour(jointColour(this.lit ?? 0)), lightness);
  }

  /** Shows the link and the symbol of its joint, which turns it, in the joint's colour; null: none. Returns whether
   * it looks different now. */
  light(joint: number | null): boolean {
    if (joint === this.lit) return false;
    this.lit = joint;
    this.paint();
    const dress = (part: Group, k: number, plain: Material): void => {
      (part.children[0] as Mesh).material = k === joint ? this.glow : plain;
    };
    for (const parts of [this.tubes, this.bends]) parts.forEach((part, i) => dress(part, jointAt(i), this.link));
    this.symbols.forEach((symbol, k) => dress(symbol, k, this.white));
    return true;
  }

  /** Makes a ghost of another tone. */
  set tone(tone: string) {
    if (!this.ghost || this.ghost.tone === tone) return;
    this.ghost.tone = tone;
    this.paint();
  }

  /** Hides the shapes of links that have meshes: link 0 is the base, link i moves with joint i. */
  cover(links: ReadonlySet<number>): void {
    const both = (joint: number): boolean => links.has(joint) && links.has(joint + 1);
    this.symbols.forEach((symbol, i) => (symbol.visible = !both(i)));
    // Tube 2 i is of link i, tube 2 i + 1 along the axis from link i to link i + 1; a bend ends each.
    const hidden = (i: number): boolean => (i % 2 === 0 ? links.has(i / 2) : both((i - 1) / 2));
    this.covered = this.tubes.map((_, i) => hidden(i));
    this.bends.forEach((bend, i) => {
      const before = i === 0 || hidden(i - 1);
      bend.visible = !(before && (i === this.tubes.length || hidden(i)));
    });
    this.tubes.forEach((tube, i) => (tube.visible &&= !this.covered[i]));
    this.base.visible = !links.has(0);
  }

  /** Shows the arm at a configuration; `up`: the z axis of its base. */
  place(skeleton: Skeleton, up: number[] = [0, 0, 1]): void {
    const vector = (values: number[]): Vector3 => new Vector3(...values);
    const line = centreLine(skeleton).map(vector);
    this.tubes.forEach((tube, i) => {
      stretch(tube, line[i] as Vector3, line[i + 1] as Vector3);
      if (this.covered[i]) tube.visible = false;
    });
    this.bends.forEach((bend, i) => bend.position.copy(line[i] as Vector3));
    this.symbols.forEach((symbol, i) => {
      const joint = skeleton.joints[i] as Skeleton["joints"][number];
      symbol.position.copy(vector(joint.centre));
      symbol.quaternion.setFromUnitVectors(along, vector(joint.direction));
    });
    this.base.position.copy(line[0] as Vector3);
    this.base.quaternion.setFromUnitVectors(along, vector(up));
  }

  /** The joint that a part of the figure turns with; null for the base. */
  jointOf(part: { userData: Record<string, unknown>; parent: unknown } | null): number | null {
    for (let now = part; now !== null && now !== this; now = now.parent as typeof part) {
      const joint = now.userData["joint"];
      if (typeof joint === "number") return joint < 0 ? null : joint;
    }
    return null;
  }

  override dispose(): this {
    this.traverse((part) => {
      if (part instanceof Mesh) (part.geometry as BufferGeometry).dispose();
    });
    for (const material of [this.link, this.white, this.foot, this.ink, this.glow, ...this.bands]) material.dispose();
    return this.removeFromParent();
  }

  private fill(list: Group[], count: number, make: () => Group): void {
    for (let i = 0; i < count; ++i) list.push(make());
    this.add(...list);
  }
}

/** The joint that tube i of the centre line moves with; -1 for the base. */
function jointAt(i: number): number {
  return Math.ceil(i / 2) - 1;
}

/** Lays a cylinder of unit height from a to b. */
function stretch(part: Group, a: Vector3, b: Vector3): void {
  const segment = b.clone().sub(a);
  const length = segment.length();
  part.visible = length > 1e-12;
  if (!part.visible) return;
  part.position.copy(a).addScaledVector(segment, 0.5);
  part.quaternion.copy(new Quaternion().setFromUnitVectors(along, segment.divideScalar(length)));
  part.scale.set(1, length, 1);
}
