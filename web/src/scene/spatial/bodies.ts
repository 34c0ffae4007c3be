import {
  Color,
  DoubleSide,
  EdgesGeometry,
  Group,
  LineBasicMaterial,
  LineSegments,
  Matrix4,
  Mesh,
  MeshLambertMaterial,
  type Object3D,
} from "three";
import { poseOfShape, type PointCloud, type SceneShape } from "../../core/scene.js";
import { resolved } from "../colours.js";
import type { DrawnBody } from "../picture.js";
import { Cloud } from "./cloud.js";
import { geometryOf } from "./shape_geometry.js";

const opacity = { obstacle: 0.72, wall: 0.15, link: 0.3 };
const sharp = 25; // degrees between faces whose edge is drawn

/** A shape that is drawn, with the text of its form: a shape that only moves is not made again. */
interface Piece {
  form: string;
  root: Group;
}

/** A point cloud that is drawn, with the points of which it is made. */
interface DrawnCloud {
  of: PointCloud;
  drawn: Cloud;
}

/** Obstacles as solids and spheres, or the shapes of links around the arm: solids are translucent, so that they hide
 * nothing. */
export class Bodies extends Group {
  private pieces: Piece[][] = [];
  private clouds: (DrawnCloud | undefined)[] = [];
  private frames: Group[] = [];
  private bodies: DrawnBody[] = [];
  private readonly fills = new Map<string, MeshLambertMaterial>();
  private readonly edge = new LineBasicMaterial({ transparent: true, opacity: 0.7 });
  private close: readonly string[] = [];
  private selected: number | null = null;

  constructor(
    private readonly kind: "obstacle" | "link",
    private readonly size: number,
  ) {
    super();
    this.paint();
  }

  show(bodies: DrawnBody[]): void {
    this.bodies = bodies;
    while (this.frames.length > bodies.length) this.drop();
    bodies.forEach((body, i) => {
      const frame = (this.frames[i] ??= new Group());
      if (frame.parent === null) this.add(frame);
      frame.matrixAutoUpdate = false;
      frame.visible = body.hidden !== true;
      this.fit(i, body.shapes);
      this.fitCloud(i, body.point_cloud);
    });
    this.dress();
  }

  /** The poses of all links, whose bodies follow them. */
  place(poses: ArrayLike<number>[]): void {
    this.bodies.forEach(({ link }, i) => {
      const pose = link === undefined ? undefined : poses[link];
      if (pose) put(this.frames[i] as Group, Array.from(pose));
    });
  }

  /** Shows the bodies of these names as too close, and one as selected. */
  mark(close: readonly string[], selected: number | null): void {
    if (selected === this.selected && close.join() === this.close.join()) return;
    [this.close, this.selected] = [close, selected];
    this.dress();
  }

  /** The index of the body that a part belongs to; null for a wall without bounds, and for what is no body. */
  indexOf(part: Object3D): number | null {
    const index = part.userData["body"] as number | undefined;
    return index ?? null;
  }

  /** Takes the colours of the page, light or dark. */
  paint(): void {
    this.edge.color = new Color(resolved("--ink"));
    for (const [key, material] of this.fills) material.color = new Color(resolved(toneOf(key)));
    if (this.clouds.length > 0) this.dress();
  }

  override dispose(): this {
    while (this.frames.length > 0) this.drop();
    for (const material of this.fills.values()) material.dispose();
    this.edge.dispose();
    return this.removeFromParent();
  }

  /** Makes the shapes of a body that are of another form, and puts all at their poses. */
  private fit(index: number, shapes: SceneShape[]): void {
    const pieces = (this.pieces[index] ??= []);
    while (pieces.length > shapes.length) remove(pieces.pop());
    shapes.forEach((shape, k) => {
      const form = JSON.stringify({ ...shape, pose: undefined });
      let piece = pieces[k];
      if (piece?.form !== form) {
        remove(piece);
        piece = { form, root: this.made(shape, index) };
        pieces[k] = piece;
        this.frames[index]?.add(piece.root);
      }
      put(piece.root, poseOfShape(shape));
    });
  }

  /** Makes the points of a body if they are others, and puts them at their pose. */
  private fitCloud(index: number, cloud: PointCloud | undefined): void {
    const before = this.clouds[index];
    if (before && (before.of.points !== cloud?.points || before.of.radius !== cloud?.radius)) this.dropCloud(index);
    if (!cloud) return;
    let kept = this.clouds[index];
    if (!kept) {
      kept = { of: cloud, drawn: new Cloud(cloud) };
      this.clouds[index] = kept;
      kept.drawn.userData["body"] = index;
      kept.drawn.matrixAutoUpdate = false;
      this.frames[index]?.add(kept.drawn);
    }
    put(kept.drawn, poseOfShape(cloud));
  }

  private dropCloud(index: number): void {
    this.clouds[index]?.drawn.removeFromParent();
    this.clouds[index]?.drawn.dispose();
    this.clouds[index] = undefined;
  }

  private made(shape: SceneShape, index: number): Group {
    const geometry = geometryOf(shape, this.size);
    const solid = new Mesh(geometry);
    solid.userData["wall"] = shape.half_space !== undefined;
    if (!shape.half_space) solid.userData["body"] = index;
    const root = new Group().add(solid);
    if (this.kind === "obstacle") root.add(new LineSegments(new EdgesGeometry(geometry, sharp), this.edge));
    root.matrixAutoUpdate = false;
    solid.renderOrder = shape.half_space ? 3 : 2;
    return root;
  }

  private drop(): void {
    for (const piece of this.pieces.pop() ?? []) remove(piece);
    this.dropCloud(this.frames.length - 1);
    this.frames.pop()?.removeFromParent();
  }

  private dress(): void {
    this.bodies.forEach(({ name }, i) => {
      const tone = this.close.includes(name) ? "close" : i === this.selected ? "selected" : "plain";
      const cloud = this.clouds[i];
      if (cloud) cloud.drawn.tone = new Color(resolved(toneOf(`${this.kind}-${tone}`)));
      for (const { root } of this.pieces[i] ?? []) {
        const solid = root.children[0] as Mesh;
        solid.material = this.fill(solid.userData["wall"] === true ? `wall-${tone}` : `${this.kind}-${tone}`);
      }
    });
  }

  private fill(key: string): MeshLambertMaterial {
    const known = this.fills.get(key);
    if (known) return known;
    const material = new MeshLambertMaterial({
      color: new Color(resolved(toneOf(key))),
      transparent: true,
      opacity: opacity[key.split("-")[0] as keyof typeof opacity],
      depthWrite: this.kind === "obstacle" && !key.startsWith("wall"),
      side: key.startsWith("wall") ? DoubleSide : 0,
    });
    this.fills.set(key, material);
    return material;
  }
}

/** The variable with the colour of "obstacle-close" and the like. */
function toneOf(key: string): string {
  const [kind = "", tone = ""] = key.split("-");
  if (tone === "close") return "--alarm";
  if (tone === "selected") return "--obstacle-selected";
  return kind === "link" ? "--steel" : "--obstacle";
}

function put(group: Object3D, pose: number[]): void {
  group.matrix.copy(new Matrix4().fromArray(pose));
  group.matrixWorldNeedsUpdate = true;
}

function remove(piece: Piece | undefined): void {
  for (const part of piece?.root.children ?? []) (part as Mesh).geometry.dispose();
  piece?.root.removeFromParent();
}
