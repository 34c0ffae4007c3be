import { Box3, type Group, Matrix4, Quaternion, Vector3 } from "three";
import { middleOfBody } from "../../core/scene.js";
import type { Skeleton } from "../../core/types.js";
import { Callout } from "../callout.js";
import { onTheme } from "../colours.js";
import type { Pixel } from "../labels.js";
import type { PathFile } from "../mesh_files.js";
import {
  centreLine,
  hasSolutions,
  noMarks,
  shortening,
  type Marks,
  type MeshReport,
  type Picture,
  type PictureParts,
} from "../picture.js";
import { pngOf } from "./space_image.js";
import { ArmFigure } from "./arm_figure.js";
import { VelocityEllipsoid } from "./ellipsoid.js";
import { Hover } from "./hover.js";
import { Arrows, putAt, trail, triad } from "./marks.js";
import { Overlay } from "./overlay.js";
import { ReachMesh } from "./reach_mesh.js";
import { ReachTiles } from "./reach_tiles.js";
import type { RobotMeshes } from "./robot_meshes.js";
import { SpaceHand } from "./space_hand.js";
import { frameLength, labelsOf, obstaclesOf, type SpatialDrawing } from "./space_labels.js";
import { Stage } from "./stage.js";
import { Surroundings } from "./surroundings.js";
import { ToolHandle } from "./tool_handle.js";

const farthestShown = 1.5; // of the reach: obstacles beyond it are not brought into the picture
const maxGhosts = 16; // their numbers fit the order of drawing and the stencil

/** The picture of a spatial arm, by WebGL. */
export class SpatialPicture implements Picture {
  readonly size: number;
  private readonly stage: Stage;
  private readonly figure: ArmFigure;
  private readonly frames: Group[];
  private readonly handle: ToolHandle;
  private readonly surroundings: Surroundings;
  private readonly hand: SpaceHand | null;
  private readonly overlay: Overlay;
  private readonly callout: Callout;
  private readonly ellipsoid: VelocityEllipsoid;
  private readonly mesh = new ReachMesh();
  private readonly tiles = new ReachTiles("--amber");
  private readonly endTheme: () => void;
  private columns: Arrows;
  private ghosts: ArmFigure[] = [];
  private trails: Group[] = [];
  private waypointFrames: Group[] = [];
  private meshes: RobotMeshes | null = null;
  private marks: Marks = noMarks;
  private q: number[] = [];
  private poses: Float64Array[] = [];
  private bones: Skeleton;
  private reading = 0;
  private moved: () => void = () => undefined;

  constructor(private readonly parts: PictureParts) {
    const { holder, arm, description, size, hand } = parts;
    this.size = size;
    this.bones = arm.skeleton(new Array<number>(arm.dof).fill(0));
    this.figure = new ArmFigure(
      this.bones.joints.map((joint) => joint.kind),
      size,
    );
    this.callout = new Callout(holder);
    this.stage = new Stage(
      holder,
      size,
      () => this.whole(),
      this.ground(),
      () => this.drawn(),
    );
    this.overlay = new Overlay(this.stage);
    if (this.stage.hasPicture) holder.append(this.overlay.root);
    holder.append(this.callout.root);
    this.frames = Array.from({ length: arm.links + 1 }, () => triad(frameLength.tool * size));
    this.ellipsoid = new VelocityEllipsoid(size / 500);
    this.columns = new Arrows(arm.dof, size / 100);
    this.stage.scene.add(this.figure, ...this.frames, this.ellipsoid, this.columns, this.mesh, this.tiles);
    this.handle = new ToolHandle(
      this.stage,
      (pose) => hand.tool(pose),
      (held) => (held ? hand.pressed() : hand.released()),
    );
    this.surroundings = new Surroundings(this.stage, size, hand);
    this.hand = this.stage.hasPicture ? new SpaceHand(holder, this.held(), hand, size) : null;
    const label = `${description.name}: arrow keys and Page Up and Down move the tool`;
    if (this.hand) this.stage.canvas.setAttribute("aria-label", label);
    this.endTheme = onTheme(() => this.paint());
    this.mark({});
  }

  private held(): ConstructorParameters<typeof SpaceHand>[1] {
    const names = this.parts.description.joints.map(({ name }) => name);
    const meshes = (): RobotMeshes | null => this.meshes;
    const hover = new Hover(this.stage.canvas, this.figure, meshes, this.overlay, names, () => this.stage.changed());
    const held = (): Marks["waypoints"] => this.marks.waypoints.filter((mark) => mark.held);
    return {
      stage: this.stage,
      figure: this.figure,
      meshes,
      handleTaken: () => this.handle.taken || this.surroundings.taken,
      handlePointed: () => this.handle.pointed || this.surroundings.pointed,
      obstacleAt: (ray) => this.surroundings.at(ray),
      obstaclePose: (index) => this.surroundings.pose(index),
      canHold: () => this.marks.handle,
      pose: () => this.poses.at(-1) ?? [],
      poses: () => this.poses,
      skeleton: () => this.bones,
      q: () => this.q,
      waypoints: () => held().map(({ pose }) => pose),
      waypointLabelled: (pixel) => {
        const label = this.overlay.labelAt(pixel, "waypoint");
        return held().findIndex((mark) => mark.label === label);
      },
      pointed: (what, mouse) => hover.show(what, mouse),
      clicked: (event) => {
        const point = this.marks.tiles ? this.tiles.at(this.stage, event) : null;
        if (point) this.parts.hand.tile(point.toArray());
      },
    };
  }

  show(q: number[], poses: Float64Array[]): void {
    const isFirst = this.poses.length === 0;
    const wasSeen = !isFirst && this.stage.sees(new Vector3(...this.bones.tool));
    [this.q, this.poses] = [q, poses];
    this.bones = this.parts.arm.skeleton(q);
    if (isFirst) this.home();
    this.figure.place(this.bones, Array.from(poses[0]?.subarray(8, 11) ?? [0, 0, 1]));
    this.frames.forEach((frame, i) => putAt(frame, poses[i] as Float64Array));
    this.handle.follow(poses.at(-1) ?? []);
    this.meshes?.place(poses);
    this.surroundings.place(poses);
    this.moved();
    this.placeColumns();
    this.stage.armChanged();
    const isHeld = this.handle.dragged || "grabbed" in this.stage.canvas.dataset;
    if (wasSeen && !isHeld && !this.stage.sees(new Vector3(...this.bones.tool))) this.stage.follow();
  }

  mark(change: Partial<Marks>): void {
    const appear =
      (hasSolutions(change.ghosts) && !hasSolutions(this.marks.ghosts)) ||
      (change.obstacles?.length ?? 0) > this.marks.obstacles.length;
    this.marks = { ...this.marks, ...change };
    if (appear) this.reveal();
    const { frames, handle, turning, tiles, surface, cell } = this.marks;
    this.frames.forEach((frame, i) => (frame.visible = frames || i === this.frames.length - 1));
    this.handle.visible = handle && this.marks.selected === null; // two would cover each other
    this.surroundings.mark(change, this.marks, this.poses);
    if ("turning" in change) this.handle.turning = turning;
    if ("ghosts" in change || "pointed" in change) this.placeGhosts();
    if ("trails" in change) this.placeTrails();
    if ("waypoints" in change) this.placeWaypoints();
    if ("tiles" in change && tiles) this.tiles.show(tiles.grid, tiles.values, tiles.normal, tiles.index, tiles.most);
    this.tiles.tilesVisible = tiles !== null;
    if (surface && "surface" in change) this.mesh.show(surface.mesh, surface.colour);
    this.mesh.visible = surface !== null;
    this.tiles.choose(cell?.centre ?? null, cell?.edge ?? 1);
    this.placeColumns();
    this.stage.changed();
  }

  say(text: string, tone: "hint" | "refusal" = "refusal"): void {
    this.callout.say(text, tone);
  }

  home(): void {
    this.stage.home();
  }

  retreat(): void {
    this.stage.retreat(new Vector3(...(this.parts.description.reach?.centre ?? [0, 0, 0])), 1.1 * this.size);
  }

  /** Where the ground is: below the disc of the arm, or at the arm's base where a mesh replaces the disc. */
  private ground(): Vector3 {
    const [x = 0, y = 0, z = 0] = this.bones.base;
    return new Vector3(x, y, z - (this.figure.stands ? this.figure.foundation + this.figure.rim : 0));
  }

  /** The arm as it stands, and a part of what it reaches. */
  private whole(): { centre: Vector3; radius: number } {
    const { base, joints, tool } = this.bones;
    const arm = [base, ...joints.map(({ centre }) => centre), tool];
    const points = [...arm, ...this.beside()].map((point) => new Vector3(...point));
    const centre = new Box3().setFromPoints(points).getCenter(new Vector3());
    const farthest = Math.max(...points.map((point) => point.distanceTo(centre)));
    return { centre, radius: Math.max(1.35 * farthest, 0.4 * this.size) };
  }

  /** Points of what is drawn beside the arm, m. */
  private beside(): number[][] {
    const { ghosts, trails, waypoints, columns, obstacles } = this.marks;
    const stands = obstacles.map(middleOfBody);
    const [x = 0, y = 0, z = 0] = this.bones.tool;
    const tip = ([dx = 0, dy = 0, dz = 0]: number[]): number[] => [
      x + shortening * dx,
      y + shortening * dy,
      z + shortening * dz,
    ];
    return [
      ...ghosts.flatMap(({ q }) => this.parts.arm.skeleton(q).joints.map(({ centre }) => centre)),
      ...trails.flatMap(({ points }) => points),
      ...waypoints.map(({ pose }) => pose.slice(12, 15)),
      ...(columns ?? []).map(tip),
      ...stands.filter((point) => Math.hypot(...point) < farthestShown * this.size),
    ];
  }

  /** Moves the viewer away where a part of what is drawn is outside the picture. */
  private reveal(): void {
    const { clientWidth, clientHeight } = this.parts.holder;
    const isInside = ([x, y]: Pixel): boolean => x > 0 && y > 0 && x < clientWidth && y < clientHeight;
    if (this.poses.length === 0 || this.beside().every((point) => isInside(this.pixel(point)))) return;
    const { centre, radius } = this.whole();
    this.stage.retreat(centre, radius);
  }

  image(): Promise<Blob | null> {
    const canvas = this.stage.snapshot();
    return canvas ? pngOf(canvas, this.overlay.root) : Promise.resolve(null);
  }

  viewer(): { azimuth: number; elevation: number } {
    return this.stage.viewer();
  }

  async showMeshes(urdf: string, links: string[], files: PathFile[], moved: () => void): Promise<MeshReport | null> {
    const { RobotMeshes: Meshes } = await import("./robot_meshes.js");
    const turn = ++this.reading; // of several readings the last one's is shown
    const meshes = await Meshes.read(urdf, links, files, this.figure.rim, () => this.stage.changed());
    if (turn !== this.reading) {
      meshes.dispose();
      return null;
    }
    this.meshes?.dispose();
    this.meshes = meshes;
    this.moved = moved;
    this.figure.cover(meshes.covered);
    this.stage.scene.add(meshes);
    if (this.poses.length > 0) meshes.place(this.poses);
    this.stage.setGround(this.ground());
    this.stage.armChanged();
    const poseOf = (frame: (typeof meshes.meshes)[number]["frame"]) => (): number[] => {
      const [position, turn] = [frame.getWorldPosition(new Vector3()), frame.getWorldQuaternion(new Quaternion())];
      return new Matrix4().compose(position, turn, new Vector3(1, 1, 1)).toArray(); // without the mesh's scale
    };
    return {
      meshes: meshes.meshes.map(({ file, link, frame }) => ({ file, link, pose: poseOf(frame) })),
      missing: meshes.missing,
      faults: meshes.faults,
    };
  }

  dispose(): void {
    ++this.reading;
    this.endTheme();
    this.meshes?.dispose();
    this.handle.dispose();
    this.surroundings.dispose();
    this.hand?.dispose();
    this.stage.dispose();
    this.overlay.root.remove();
    this.callout.root.remove();
  }

  /** Takes the colours of the page, light or dark. */
  private paint(): void {
    for (const figure of [this.figure, ...this.ghosts]) figure.paint();
    this.meshes?.paint();
    this.handle.paint();
    this.surroundings.paint(this.marks.gaps);
    this.columns.dispose();
    this.columns = new Arrows(this.parts.arm.dof, this.size / 100);
    this.stage.scene.add(this.columns);
    this.mark({ trails: this.marks.trails });
  }

  private placeColumns(): void {
    const { columns, ellipsoid } = this.marks;
    const tool = this.poses.at(-1);
    const at = new Vector3(tool?.[12], tool?.[13], tool?.[14]);
    const vectors = (values: number[][]): Vector3[] => values.map((column) => new Vector3(...column.slice(0, 3)));
    this.columns.visible = columns !== null;
    if (columns)
      this.columns.place(
        at,
        vectors(columns).map((vector) => vector.multiplyScalar(shortening)),
      );
    this.ellipsoid.visible = ellipsoid !== null;
    if (ellipsoid) this.ellipsoid.place(at, vectors(ellipsoid), shortening);
  }

  private placeGhosts(): void {
    const { pointed } = this.marks;
    const ghosts = this.marks.ghosts.slice(0, maxGhosts);
    while (this.ghosts.length > ghosts.length) this.ghosts.pop()?.dispose();
    ghosts.forEach(({ q, tone }, i) => {
      let ghost = this.ghosts[i];
      if (!ghost) {
        ghost = new ArmFigure(this.figure.kinds, this.size, { tone: `--ghost-${tone}`, index: i });
        this.ghosts[i] = ghost;
        this.stage.scene.add(ghost);
      }
      ghost.tone = `--ghost-${tone}`;
      ghost.visible = pointed === null || pointed === i;
      ghost.place(this.parts.arm.skeleton(q));
    });
  }

  private placeTrails(): void {
    for (const group of this.trails) group.removeFromParent();
    this.trails = this.marks.trails.map((one) => trail(one, this.size));
    if (this.trails.length > 0) this.stage.scene.add(...this.trails);
  }

  private placeWaypoints(): void {
    const { waypoints } = this.marks;
    while (this.waypointFrames.length > waypoints.length) this.waypointFrames.pop()?.removeFromParent();
    waypoints.forEach(({ pose }, i) => {
      const frame = (this.waypointFrames[i] ??= triad(frameLength.waypoint * this.size));
      if (frame.parent === null) this.stage.scene.add(frame);
      putAt(frame, pose);
    });
  }

  /** Writes labels over the picture, and keeps in the attribute data-tool where it shows the tool, in pixels. */
  private drawn(): void {
    const { holder } = this.parts;
    const tool = this.poses.at(-1);
    if (!tool) return;
    const at = new Vector3(tool[12], tool[13], tool[14]);
    const [x, y] = this.stage.pixel(at);
    holder.dataset["tool"] = `${x.toFixed(1)},${y.toFixed(1)}`;
    const handle = this.marks.handle && !this.marks.turning ? ([x, y] as const) : null;
    const { drawing } = this;
    const { taken, obstacles } = this.overlay.place(
      holder.clientWidth,
      holder.clientHeight,
      labelsOf(drawing),
      obstaclesOf(drawing),
      handle,
    );
    this.callout.place([x, y], obstacles, taken);
  }

  private get drawing(): SpatialDrawing {
    const { marks, poses, bones, size, parts, stage, handle, figure } = this;
    const thick = 1.65 * figure.radius * stage.pixelsPerMetre; // of the symbols of the joints
    const ghosts = marks.ghosts
      .filter(({ tone }) => tone !== "solution")
      .map(({ q }) => centreLine(parts.arm.skeleton(q)));
    const grips = handle.points().map((point) => stage.pixel(point));
    return { marks, poses, bones, size, ghosts, grips, thick, pixel: (point) => this.pixel(point) };
  }

  private pixel(point: ArrayLike<number>): Pixel {
    return this.stage.pixel(new Vector3(point[0], point[1], point[2]));
  }
}
