import type { Vector3 } from "three";
import { largest, type ReachMap, type ReachSurface } from "../core/reach.js";
import { levelOf, sliceIndex } from "../panels/reach_display.js";
import { shade } from "../scene/colour_scale.js";
import { ReachMesh } from "../scene/reach_mesh.js";
import { ReachTiles } from "../scene/reach_tiles.js";
import type { PageState } from "../state/page_state.js";
import type { ArmView } from "./arm_view.js";

const frameColour = 0xd95f02;
const darkest = 0.3; // of the scale, for a surface that is seen on a dark ground
const stillness = 4; // pixels between press and release of a click

/** A map in the picture of an arm: its surface, the tiles of a slice, and the cell that is chosen. */
export class ReachPicture {
  private readonly mesh = new ReachMesh();
  private readonly tiles = new ReachTiles(frameColour);

  /** `clicked` gets the point of a tile that was clicked. */
  constructor(
    private readonly view: ArmView,
    clicked: (point: Vector3) => void,
  ) {
    const { stage } = view;
    let pressed: MouseEvent | null = null;
    stage.canvas.addEventListener("pointerdown", (event) => (pressed = event));
    stage.canvas.addEventListener("click", (event) => {
      if (!pressed || !this.tiles.parent) return;
      if (Math.hypot(event.clientX - pressed.clientX, event.clientY - pressed.clientY) > stillness) return;
      const point = this.tiles.at(stage, event);
      if (point) clicked(point);
    });
    this.clear();
  }

  showTiles(map: ReachMap, state: PageState, planar: boolean): void {
    const normal = planar ? 2 : state.sliceNormal;
    const values = map.values[state.measure];
    const index = sliceIndex(map, { ...state, sliceNormal: normal });
    this.tiles.show(map, values, normal, index, largest(map, state.measure));
    this.tiles.tilesVisible = state.showSlice;
    this.view.stage.changed();
  }

  showSurface(surface: ReachSurface, map: ReachMap, { measure, level }: PageState): void {
    const fraction = levelOf(map, measure, level) / largest(map, measure);
    this.mesh.show(surface, shade(Math.max(darkest, fraction)));
    this.surfaceVisible = true;
  }

  set surfaceVisible(visible: boolean) {
    this.mesh.visible = visible;
    this.view.stage.changed();
  }

  /** Frames the cell around a point, or none. */
  choose(map: ReachMap, centre: number[] | null): void {
    this.tiles.choose(centre, map.axes[0].step);
    this.view.stage.changed();
  }

  /** Until there is a map. */
  clear(): void {
    this.mesh.visible = this.tiles.tilesVisible = false;
    this.tiles.choose(null, 1);
    this.view.stage.changed();
  }

  enter(): void {
    this.view.stage.scene.add(this.mesh, this.tiles);
  }

  leave(): void {
    this.mesh.removeFromParent();
    this.tiles.removeFromParent();
    this.view.stage.changed();
  }

  dispose(): void {
    this.mesh.dispose();
    this.tiles.dispose();
  }
}
