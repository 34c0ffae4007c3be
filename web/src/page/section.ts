import type { Arm } from "../core/arm.js";
import type { ArmDescription } from "../core/description.js";
import type { ReachAnswers, ReachTask } from "../core/reach.js";
import type { CommandResult, InputFiles } from "../core/types.js";
import type { Marks, Picture } from "../scene/picture.js";
import type { PageState } from "../state/page_state.js";
import type { Store } from "../state/store.js";

/** The arm that the page shows. */
export interface Shown {
  arm: Arm;
  description: ArmDescription;
  picture: Picture;
}

/** The marks that a section draws. */
export type SectionMarks = Partial<
  Pick<
    Marks,
    | "moving"
    | "ghosts"
    | "trails"
    | "waypoints"
    | "extent"
    | "tiles"
    | "surface"
    | "cell"
    | "obstaclesHeld"
    | "selected"
  >
>;

/** What a section may ask of the page. */
export interface Services {
  store: Store<PageState>;
  /** Runs a command of the command line in the worker, where the arm is the file arm.json; cancel() ends it. */
  command(args: string[], files?: InputFiles, progress?: (fraction: number) => void): Promise<CommandResult>;
  /** The same with --scene, if there are obstacles and the arm has shapes. */
  inScene(args: string[], files?: InputFiles, progress?: (fraction: number) => void): Promise<CommandResult>;
  /** What the answers of inScene() depend on beside the arm: its shapes, the obstacles and the clearance; empty without
   * obstacles. */
  surroundings(): string;
  /** Why inScene() does not check the obstacles; empty: it does, or there are none. */
  unchecked(): string;
  /** Answers a question about a map of what an arm can do, in the same worker. */
  reach<T extends ReachTask>(task: T, progress?: (fraction: number) => void): Promise<ReachAnswers[T["ask"]]>;
  cancel(): void;
  /** Draws marks beside the arm, until the section is left. Those that are not named stay. */
  draw(marks: SectionMarks): void;
}

/** A section of the page, beside the picture; its parts are in panels/. */
export interface PageSection {
  readonly root: HTMLElement;
  /** Takes another arm. */
  take(shown: Shown): void;
  /** The state has changed, or the section is shown from now on. Called only while it is shown. */
  update(q: number[], changed: ReadonlySet<keyof PageState>): void;
  /** Another section is shown from now on. Its marks are taken out of the picture. */
  leave(): void;
  /** A waypoint was dragged to a pose, a column-major 4 x 4 matrix, or dropped there. */
  waypoint?(index: number, pose: number[], released: boolean): void;
  /** A tile of the section was clicked at this point. */
  tile?(point: number[]): void;
  /** An obstacle was taken hold of, `pose` null, or dragged to a pose. */
  obstacle?(index: number, pose: number[] | null): void;
  /** A hand has dropped the arm in front of joint values that an obstacle keeps it from; it could stand there. */
  dropped?(q: number[]): void;
  /** A hand has taken hold of the arm: what moves it by itself stops. */
  interrupt?(): void;
}
