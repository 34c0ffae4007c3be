import {
  BoxGeometry,
  BufferAttribute,
  BufferGeometry,
  Color,
  DataTexture,
  DoubleSide,
  EdgesGeometry,
  Group,
  LineBasicMaterial,
  LineSegments,
  Mesh,
  MeshBasicMaterial,
  NearestFilter,
  Raycaster,
  SRGBColorSpace,
  Vector2,
  Vector3,
} from "three";
import { centreOf, sliceOf, type ReachGrid } from "../../core/reach.js";
import { resolved } from "../colours.js";
import { shade } from "../colour_scale.js";
import type { Stage } from "./stage.js";

/** The positions of a map in a plane, a tile in the colour of its value each, and a frame around the one that is chosen.
 * A position without a value has no tile. */
export class ReachTiles extends Group {
  private readonly plane: Mesh<BufferGeometry, MeshBasicMaterial>;
  private readonly frame: LineSegments;

  constructor(colour: string) {
    super();
    const material = new MeshBasicMaterial({
      transparent: true,
      opacity: 0.75,
      depthWrite: false,
      side: DoubleSide,
      polygonOffset: true, // in front of the grid on the ground
      polygonOffsetFactor: -1,
      polygonOffsetUnits: -1,
    });
    this.plane = new Mesh(new BufferGeometry(), material);
    this.frame = new LineSegments(
      new EdgesGeometry(new BoxGeometry()),
      new LineBasicMaterial({ color: new Color(resolved(colour)) }),
    );
    this.frame.visible = false;
    this.add(this.plane, this.frame);
  }

  /** Shows the values at the positions in the plane `index` of the axis `normal`, the largest one as `most`. */
  show(grid: ReachGrid, values: Float32Array, normal: number, index: number, most: number): void {
    const slice = sliceOf(grid, values, normal, index);
    const [a, b] = slice.axes.map((k) => grid.axes[k]) as [ReachGrid["axes"][0], ReachGrid["axes"][0]];
    const pixels = new Uint8Array(4 * slice.values.length);
    for (let i = 0; i < a.cells; ++i) {
      for (let j = 0; j < b.cells; ++j) {
        const value = slice.values[i * b.cells + j] as number;
        if (!Number.isNaN(value)) pixels.set([...shade(value / most), 255], 4 * (j * a.cells + i));
      }
    }
    const texture = new DataTexture(pixels, a.cells, b.cells);
    texture.colorSpace = SRGBColorSpace;
    texture.magFilter = texture.minFilter = NearestFilter;
    texture.needsUpdate = true;
    this.plane.material.map?.dispose();
    this.plane.material.map = texture;
    this.plane.material.needsUpdate = true;
    this.plane.geometry.dispose();
    this.plane.geometry = rectangle(grid, normal, index, slice.axes);
  }

  /** Where the tiles lie below a point of the picture; null beside them. */
  at(stage: Stage, event: MouseEvent): Vector3 | null {
    const { left, top, width, height } = stage.canvas.getBoundingClientRect();
    const point = new Vector2((2 * (event.clientX - left)) / width - 1, 1 - (2 * (event.clientY - top)) / height);
    const ray = new Raycaster();
    ray.setFromCamera(point, stage.camera);
    return ray.intersectObject(this.plane)[0]?.point ?? null;
  }

  /** Frames the cell around a point; none where it is null. */
  choose(point: number[] | null, edge: number): void {
    this.frame.visible = point !== null;
    this.frame.position.set(...((point ?? [0, 0, 0]) as [number, number, number]));
    this.frame.scale.setScalar(edge);
  }

  set tilesVisible(visible: boolean) {
    this.plane.visible = visible;
  }

  override dispose(): this {
    this.plane.material.map?.dispose();
    for (const part of [this.plane, this.frame]) {
      part.geometry.dispose();
      (part.material as MeshBasicMaterial | LineBasicMaterial).dispose();
    }
    return this.removeFromParent();
  }
}

/** The rectangle of a slice in the world, the corners of the picture at its corners. */
function rectangle(grid: ReachGrid, normal: number, index: number, [a, b]: [number, number]): BufferGeometry {
  const height = centreOf(grid.axes[normal] as ReachGrid["axes"][0], index);
  const end = (k: number, upper: number): number => {
    const { lower, step, cells } = grid.axes[k] as ReachGrid["axes"][0];
    return lower + upper * step * cells;
  };
  const corners = [
    [0, 0],
    [1, 0],
    [1, 1],
    [0, 1],
  ] as const;
  const points = corners.flatMap(([u, v]) => [height, height, height].with(a, end(a, u)).with(b, end(b, v)));
  const geometry = new BufferGeometry();
  geometry.setAttribute("position", new BufferAttribute(new Float32Array(points), 3));
  geometry.setAttribute("uv", new BufferAttribute(new Float32Array(corners.flat()), 2));
  geometry.setIndex([0, 1, 2, 0, 2, 3]);
  return geometry;
}
