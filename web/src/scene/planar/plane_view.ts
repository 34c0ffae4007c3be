import type { Pixel } from "../labels.js";

/** Space around the plot for the numbers of its axes, pixels. */
export const margin = { left: 60, right: 12, top: 12, bottom: 40 };

/** A rectangle of the world, m. */
export interface Extent {
  low: [number, number];
  high: [number, number];
}

/** The rectangle around points, m, and `around` them. */
export function extentOf(points: ArrayLike<number>[], around: number): Extent {
  const side = (k: 0 | 1, sign: 1 | -1): number =>
    sign * points.reduce((most, point) => Math.max(most, sign * (point[k] ?? 0)), -Infinity) + sign * around;
  return { low: [side(0, -1), side(1, -1)], high: [side(0, 1), side(1, 1)] };
}

const farthest = 1e9; // pixels: a drawing computes with single precision

/** Where the plane is seen: the world's point in the middle of the plot, and pixels for a metre. */
export class PlaneView {
  width = 1;
  height = 1;
  scale = 1;
  centre: Pixel = [0, 0];

  /** Shows a part of the world. */
  fit({ low, high }: Extent): void {
    this.centre = [(low[0] + high[0]) / 2, (low[1] + high[1]) / 2];
    const fits = [this.plotWidth / (high[0] - low[0]), this.plotHeight / (high[1] - low[1])];
    this.scale = Math.max(1e-9, Math.min(...fits));
  }

  /** Whether all of a part of the world is seen. */
  shows({ low, high }: Extent): boolean {
    const [left, bottom] = this.pixel(low);
    const [right, top] = this.pixel(high);
    return (
      left >= margin.left &&
      right <= margin.left + this.plotWidth &&
      top >= margin.top &&
      bottom <= margin.top + this.plotHeight
    );
  }

  get plotWidth(): number {
    return Math.max(1, this.width - margin.left - margin.right);
  }

  get plotHeight(): number {
    return Math.max(1, this.height - margin.top - margin.bottom);
  }

  get middle(): Pixel {
    return [margin.left + this.plotWidth / 2, margin.top + this.plotHeight / 2];
  }

  /** The pixel of a point of the world, at most `farthest` away from the middle of the plot. */
  pixel(point: ArrayLike<number>): Pixel {
    const [cx, cy] = this.middle;
    const away = (i: 0 | 1): number =>
      Math.min(farthest, Math.max(-farthest, ((point[i] ?? 0) - this.centre[i]) * this.scale));
    return [cx + away(0), cy - away(1)];
  }

  world([x, y]: Pixel): [number, number] {
    const [cx, cy] = this.middle;
    return [this.centre[0] + (x - cx) / this.scale, this.centre[1] - (y - cy) / this.scale];
  }

  /** Moves what is at a pixel to another one, and magnifies around it. */
  move(from: Pixel, to: Pixel, factor: number): void {
    const point = this.world(from);
    this.scale = Math.min(1e7, Math.max(1e-4, this.scale * factor));
    const [cx, cy] = this.middle;
    this.centre = [point[0] - (to[0] - cx) / this.scale, point[1] + (to[1] - cy) / this.scale];
  }

  /** Pixels for a point of the figures, which are drawn for paper. */
  get unit(): number {
    return Math.min(1.5, Math.max(1, Math.min(this.width, this.height) / 460));
  }
}
