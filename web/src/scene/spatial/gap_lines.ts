import { BufferGeometry, Color, Group, Line, LineBasicMaterial, Points, PointsMaterial, Vector3 } from "three";
import { resolved } from "../colours.js";
import type { Gap } from "../picture.js";
import { disc } from "./marks.js";

/** The lines between the nearest points of two bodies, over everything. */
export class GapLines extends Group {
  private readonly dot = disc();
  private lines: GapLine[] = [];

  show(gaps: Gap[]): void {
    while (this.lines.length > gaps.length) this.lines.pop()?.dispose();
    gaps.forEach((gap, i) => {
      const line = (this.lines[i] ??= new GapLine(this.dot));
      if (line.parent === null) this.add(line);
      line.show(gap);
    });
  }

  override dispose(): this {
    this.show([]);
    this.dot.dispose();
    return this.removeFromParent();
  }
}

class GapLine extends Group {
  private readonly places = new BufferGeometry().setFromPoints([new Vector3(), new Vector3()]);
  private readonly line = new LineBasicMaterial({ depthTest: false, transparent: true });
  private readonly ends: PointsMaterial;

  constructor(dot: ReturnType<typeof disc>) {
    super();
    this.ends = new PointsMaterial({ size: 8, sizeAttenuation: false, map: dot, alphaTest: 0.5, depthTest: false });
    this.ends.transparent = true; // drawn with the line, after the bodies
    const parts = [new Line(this.places, this.line), new Points(this.places, this.ends)];
    for (const part of parts) {
      part.renderOrder = 5;
      part.frustumCulled = false; // its points move
    }
    this.add(...parts);
  }

  show(gap: Gap): void {
    this.places.setFromPoints(gap.points.map((point) => new Vector3(...point)));
    this.line.color = this.ends.color = new Color(resolved(gap.close ? "--alarm" : "--text"));
  }

  override dispose(): this {
    for (const part of [this.places, this.line, this.ends]) part.dispose();
    return this.removeFromParent();
  }
}
