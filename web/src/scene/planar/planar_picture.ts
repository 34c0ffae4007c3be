import { hasFullTask } from "../../core/nearest.js";
import { headingOf } from "../../core/pose.js";
import type { Skeleton } from "../../core/types.js";
import { arrowOf, set, svg } from "../../elements/svg.js";
import { shown } from "../../elements/element.js";
import { Callout } from "../callout.js";
import { onTheme } from "../colours.js";
import {
  hasSolutions,
  noMarks,
  shortening,
  type Marks,
  type MeshReport,
  type Picture,
  type PictureParts,
} from "../picture.js";
import { Angles } from "./angles.js";
import { Axes } from "./axes.js";
import { Frames, tips, triad } from "./frames.js";
import { along, columnLabels, Labels, thinned, wide, type Label, type Obstacle, type Pixel } from "../labels.js";
import { linkLines, linkWidth, PlanarArm, sizeFor } from "./planar_arm.js";
import { PlaneHand } from "./plane_hand.js";
import { Columns, heightOf, PlaneTiles, Trails, VelocityEllipse, Waypoints } from "./plane_marks.js";
import { extentOf, margin, PlaneView, type Extent } from "./plane_view.js";
import { pngOf } from "./plane_image.js";

const grip = 15; // pixels: the radius of what turns it, for a finger
const knob = 46; // pixels from the tool to what turns it
/** Of the reach: what is seen around the arm at first, and around what would leave the picture. */
const around = { first: 0.28, later: 0.12, least: 0.03 };

/** The picture of a planar arm, a drawing like the figures of `beeline draw`. It needs no WebGL. */
export class PlanarPicture implements Picture {
  readonly size: number;
  private readonly view = new PlaneView();
  private readonly root: SVGSVGElement;
  private readonly axes = new Axes();
  private readonly clip = svg("rect");
  private readonly tiles = new PlaneTiles();
  private readonly ghosts = svg("g");
  private readonly arm: PlanarArm;
  private readonly trails = new Trails();
  private readonly frames = new Frames();
  private readonly toolFrame = svg("g", { class: "frames" });
  private readonly angles = new Angles();
  private readonly columns = new Columns();
  private readonly ellipse = new VelocityEllipse();
  private readonly waypoints = new Waypoints();
  private readonly handle = svg("g", { class: "handle" });
  private readonly labels = new Labels();
  private readonly callout: Callout;
  private readonly drawnGhosts: PlanarArm[] = [];
  private readonly resize: ResizeObserver;
  private readonly endTheme: () => void;
  private marks: Marks = noMarks;
  private q: number[] = [];
  private poses: Float64Array[] = [];
  private bones: Skeleton;
  private ghostBones: Skeleton[] = [];
  private turner: Pixel = [0, 0];
  private waiting = false;
  private atHome = true;
  private whole: Extent | null = null; // what is seen of the world, while it is the whole arm
  private disposed = false;

  constructor(private readonly parts: PictureParts) {
    const { holder, arm, description, size } = parts;
    this.size = size;
    this.bones = arm.skeleton(new Array<number>(arm.dof).fill(0));
    this.callout = new Callout(holder);
    this.arm = new PlanarArm(
      "",
      description.joints.map(({ name }) => name),
    );
    const inside = svg("g", { "clip-path": "url(#plot)" });
    inside.append(
      this.tiles.root,
      this.ghosts,
      this.ellipse.root,
      this.arm.root,
      this.trails.root,
      this.angles.root,
      this.frames.root,
      this.toolFrame,
      this.columns.root,
      this.waypoints.root,
      this.handle,
      this.labels.root,
    );
    this.root = svg(
      "svg",
      {
        class: "drawing",
        tabindex: 0,
        role: "application",
        "aria-label": `${description.name}: arrow keys move the tool, Q and E turn it`,
      },
      svg("defs", {}, svg("clipPath", { id: "plot" }, this.clip)),
      this.axes.root,
      inside,
    );
    this.buildHandle();
    holder.replaceChildren(this.root, this.callout.root);
    new PlaneHand(this.root, this.held(), parts.hand);
    this.resize = new ResizeObserver(() => this.fit());
    this.resize.observe(holder);
    this.endTheme = onTheme(() => this.changed());
    this.fit();
  }

  private held(): ConstructorParameters<typeof PlaneHand>[1] {
    return {
      view: this.view,
      pose: () => this.poses.at(-1) ?? [],
      skeleton: () => this.bones,
      q: () => this.q,
      waypoint: (index) => this.marks.waypoints[index]?.pose ?? [],
      moved: () => {
        this.atHome = false;
        this.changed();
      },
      home: () => this.home(),
      clicked: (point) => this.clicked(point),
    };
  }

  show(q: number[], poses: Float64Array[]): void {
    const seesTool = (): boolean => this.view.shows(extentOf([this.bones.tool], 0));
    const wasSeen = this.poses.length > 0 && seesTool();
    [this.q, this.poses] = [q, poses];
    this.bones = this.parts.arm.skeleton(q);
    // Where the view was moved, it goes back to the whole arm when a number takes the tool out of it.
    if (!this.atHome && wasSeen && !("grabbed" in this.root.dataset) && !seesTool()) this.home();
    this.changed();
  }

  mark(change: Partial<Marks>): void {
    const appear = hasSolutions(change.ghosts) && !hasSolutions(this.marks.ghosts);
    this.marks = { ...this.marks, ...change };
    if (change.ghosts) this.ghostBones = change.ghosts.map(({ q }) => this.parts.arm.skeleton(q));
    if (appear && !this.view.shows(extentOf(this.ghostJoints, 0))) this.home();
    this.changed();
  }

  private get ghostJoints(): number[][] {
    return this.ghostBones.flatMap(({ joints }) => joints.map(({ centre }) => centre));
  }

  say(text: string, tone: "hint" | "refusal" = "refusal"): void {
    this.callout.say(text, tone);
  }

  home(): void {
    this.atHome = true;
    this.whole = null;
    this.changed();
  }

  retreat(): void {
    this.atHome = true;
    this.whole = extentOf([this.parts.description.reach?.centre ?? [0, 0]], 1.12 * this.size);
    this.changed();
  }

  /** Shows the arm and its surroundings; more where the arm or what is drawn beside it would leave the picture, but not
   * while a hand holds the arm. */
  private showWhole(): void {
    const { base, joints, tool } = this.bones;
    const { trails, waypoints, extent, columns } = this.marks;
    const beside = [
      ...this.ghostJoints,
      ...(columns ?? []).map((column) => tool.map((value, i) => value + shortening * (column[i] ?? 0))),
      ...trails.flatMap(({ points }) => points),
      ...waypoints.map(({ pose }) => pose.slice(12)),
      ...extent,
    ];
    const points = [base, ...joints.map(({ centre }) => centre), tool, ...beside];
    this.whole ??= extentOf(points, around.first * this.size);
    this.view.fit(this.whole);
    if ("grabbed" in this.root.dataset || this.view.shows(extentOf(points, around.least * this.size))) return;
    const { low, high } = extentOf(points, around.later * this.size);
    this.whole = extentOf([this.whole.low, this.whole.high, low, high], 0);
    this.view.fit(this.whole);
  }

  image(): Promise<Blob | null> {
    this.draw();
    return pngOf(this.root);
  }

  viewer(): null {
    return null;
  }

  showMeshes(): Promise<MeshReport | null> {
    return Promise.resolve(null); // a drawing has no meshes
  }

  dispose(): void {
    this.disposed = true;
    this.resize.disconnect();
    this.endTheme();
    this.root.remove();
    this.callout.root.remove();
  }

  private fit(): void {
    const { clientWidth: width, clientHeight: height } = this.parts.holder;
    if (width === 0 || height === 0) return;
    [this.view.width, this.view.height] = [width, height];
    set(this.root, { width, height, viewBox: `0 0 ${width} ${height}` });
    this.changed();
  }

  /** Draws soon: a page at rest costs nothing. */
  private changed(): void {
    if (this.waiting) return;
    this.waiting = true;
    requestAnimationFrame(() => {
      this.waiting = false;
      if (!this.disposed) this.draw();
    });
  }

  private draw(): void {
    const { view, marks, poses, bones } = this;
    const tool = poses.at(-1);
    if (!tool) return;
    if (this.atHome) this.showWhole();
    set(this.clip, { x: margin.left, y: margin.top, width: view.plotWidth, height: view.plotHeight });
    this.axes.place(view);
    this.tiles.place(marks.tiles, marks.cell, view);
    this.placeGhosts();
    this.arm.place(bones, view);
    this.root.dataset["handle"] = String(marks.handle);
    this.root.dataset["tiles"] = String(marks.tiles !== null);
    const at = [tool[12] ?? 0, tool[13] ?? 0];
    this.trails.place(marks.trails, view);
    this.angles.root.style.display = marks.angles ? "" : "none";
    const values = marks.angles ? this.angles.place(bones, this.q, poses, view, marks.degrees) : [];
    this.frames.root.style.display = marks.frames ? "" : "none";
    const frames = marks.frames ? this.frames.place(framesOf(poses), view, this.size) : { labels: [], obstacles: [] };
    triad(tool, view, 30 * view.unit, this.toolFrame);
    this.columns.place(marks.columns, at, view);
    this.ellipse.place(marks.ellipsoid, at, view);
    this.waypoints.place(marks.waypoints, view);
    this.placeHandle(tool);
    const numbers = marks.waypoints.map(({ pose, label, held }, i): Label => {
      const at = view.pixel(pose.slice(12, 14));
      const grab = held ? { grab: `waypoint ${i}` } : {};
      return { key: `waypoint ${label}`, text: label, at, away: 10, angle: 0.8, kind: "waypoint", ...grab };
    });
    const angles = marks.moving ? [] : values;
    const columns = columnLabels(marks.columns, at, (point) => view.pixel(point), view.pixel(at));
    this.placeLabels([...numbers, this.poseLabel(tool), ...angles, ...columns, ...frames.labels], frames.obstacles);
  }

  /** Writes the labels, and the sentence at the tool, clear of the arm, its handle and what is drawn beside it. */
  private placeLabels(labels: Label[], frames: Pixel[]): void {
    const { view } = this;
    const obstacles = [...frames, ...this.obstacles()];
    const bounds = { x: margin.left, y: margin.top, width: view.plotWidth, height: view.plotHeight };
    const boxes = this.labels.place(labels, obstacles, bounds);
    this.callout.place(view.pixel(this.bones.tool), obstacles, boxes);
  }

  /** What texts should not cover. */
  private obstacles(): Obstacle[] {
    const { view, marks } = this;
    const links = linkLines(this.bones).links.map((line) => line.map((point) => view.pixel(point)));
    const ghosts = this.ghostBones.flatMap((bones) => linkLines(bones).links);
    const ring = ([x, y]: Pixel): Pixel[] =>
      [0, 1, 2, 3, 4, 5].map((k) => [x + 12 * Math.cos(k), y + 12 * Math.sin(k)]);
    const tool = view.pixel(this.bones.tool);
    const axes = (pose: ArrayLike<number>, pixels: number): Pixel[] => {
      const at = view.pixel([pose[12] ?? 0, pose[13] ?? 0]);
      return tips(pose, view, pixels).flatMap((tip) => along([at, tip]));
    };
    const [bx, by] = view.pixel(this.bones.base);
    const support = [-14, -7, 0, 7, 14].map((x): Pixel => [bx + x * view.unit, by + 14 * view.unit]);
    const trails = marks.trails.map(({ points }) => points.map((point) => view.pixel(point)));
    const width = linkWidth * view.unit * sizeFor(this.bones.joints.length);
    return [
      ...support,
      ...wide(links.flatMap(along), 2 + width / 2),
      ...ghosts.flatMap((line) => along(line.map((point) => view.pixel(point)))),
      ...trails.flatMap(thinned),
      ...marks.waypoints.flatMap(({ pose }) => [...ring(view.pixel(pose.slice(12, 14))), ...axes(pose, 26)]),
      ...axes(this.poses.at(-1) ?? [], 30 * view.unit),
      ...ring(tool),
      ...(marks.handle && this.canTurn ? [...along([tool, this.turner]), ...ring(this.turner)] : []),
    ];
  }

  private poseLabel(tool: Float64Array): Label {
    const heading = headingOf(tool);
    const degrees = this.marks.degrees ? `${shown((heading * 180) / Math.PI, 1)}°` : `${shown(heading, 3)} rad`;
    const digits = this.size >= 0.5 ? 2 : 3;
    const text = `(${shown(tool[12] ?? 0, digits)}, ${shown(tool[13] ?? 0, digits)}, ${degrees})`;
    const at = this.view.pixel([tool[12] ?? 0, tool[13] ?? 0]);
    return { key: "pose", text, at, away: 18, angle: heading - Math.PI / 3, kind: "pose" };
  }

  private placeGhosts(): void {
    const { ghosts, pointed } = this.marks;
    while (this.drawnGhosts.length > ghosts.length) this.drawnGhosts.pop()?.root.remove();
    ghosts.forEach(({ q, tone }, i) => {
      const ghost = (this.drawnGhosts[i] ??= new PlanarArm("solution"));
      if (ghost.root.parentNode === null) this.ghosts.append(ghost.root);
      set(ghost.root, { class: `arm ghost ${tone}` });
      ghost.root.style.display = pointed === null || pointed === i ? "" : "none";
      ghost.place(this.parts.arm.skeleton(q), this.view);
    });
  }

  private get canTurn(): boolean {
    return hasFullTask(this.parts.arm);
  }

  private buildHandle(): void {
    this.handle.append(
      svg("path", { class: "stem" }),
      svg("circle", { class: "ring", r: 13 }),
      svg("circle", { class: "knob", r: 5 }),
      svg("circle", { class: "grip", r: grip, "data-grab": "turn" }, svg("title", {}, "turn about z")),
      svg("circle", { class: "grip", r: 20, "data-grab": "tool" }, svg("title", {}, "move the tool in x and y")),
    );
  }

  private placeHandle(tool: Float64Array): void {
    const [x, y] = this.view.pixel([tool[12] ?? 0, tool[13] ?? 0]);
    this.turner = this.turnerAt([x, y], headingOf(tool));
    const [kx, ky] = this.turner;
    const [stem, ring, knobCircle, turn, grip] = [...this.handle.children] as SVGElement[];
    set(stem as SVGElement, { d: arrowOf([x, y], [kx, ky], 0).line });
    for (const part of [ring, grip]) set(part as SVGElement, { cx: x.toFixed(2), cy: y.toFixed(2) });
    for (const part of [stem, knobCircle, turn]) (part as SVGElement).style.display = this.canTurn ? "" : "none";
    for (const part of [knobCircle, turn]) set(part as SVGElement, { cx: kx.toFixed(2), cy: ky.toFixed(2) });
    this.parts.holder.dataset["tool"] = `${x.toFixed(1)},${y.toFixed(1)}`;
  }

  /** Where the tool is turned: ahead of it, or on another side of it where that lies outside the picture. */
  private turnerAt([x, y]: Pixel, heading: number): Pixel {
    const { view } = this;
    const far = knob * view.unit;
    const sides = [0, Math.PI / 2, -Math.PI / 2, Math.PI].map((side): Pixel => [
      x + far * Math.cos(heading + side),
      y - far * Math.sin(heading + side),
    ]);
    const inside = ([px, py]: Pixel): boolean =>
      px > margin.left + grip &&
      px < margin.left + view.plotWidth - grip &&
      py > margin.top + grip &&
      py < margin.top + view.plotHeight - grip;
    return sides.find(inside) ?? (sides[0] as Pixel);
  }

  private clicked(point: Pixel): void {
    const { tiles } = this.marks;
    const hit = tiles ? this.tiles.at(this.view.world(point), heightOf(tiles)) : null;
    if (hit) this.parts.hand.tile(hit);
  }
}

/** The frames of the links, and the frame of the tool unless it is the last link's. */
function framesOf(poses: Float64Array[]): Float64Array[] {
  const [last, tool] = poses.slice(-2);
  const same = last?.every((value, i) => Math.abs(value - (tool?.[i] ?? 0)) < 1e-9);
  return same ? poses.slice(0, -1) : poses;
}
