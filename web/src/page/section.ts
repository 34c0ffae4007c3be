import type { Arm } from "../core/arm.js";
import type { ReachAnswers, ReachTask } from "../core/reach.js";
import type { CommandResult, Files } from "../core/types.js";
import type { PageState } from "../state/page_state.js";
import type { Store } from "../state/store.js";
import type { ArmView } from "./arm_view.js";
import type { ArmDescription } from "../core/description.js";

/** The arm that the page shows. */
export interface Shown {
  arm: Arm;
  description: ArmDescription;
  view: ArmView;
}

/** What a section may ask of the page. */
export interface Services {
  store: Store<PageState>;
  /** Runs a command of the command line in the worker, where the arm is the file arm.json; cancel() ends it. */
  command(args: string[], files?: Files, progress?: (fraction: number) => void): Promise<CommandResult>;
  /** Answers a question about a map of what an arm can do, in the same worker. */
  reach<T extends ReachTask>(task: T, progress?: (fraction: number) => void): Promise<ReachAnswers[T["ask"]]>;
  cancel(): void;
}

/** A section of the page: a panel beside the picture. */
export interface SectionPanel {
  readonly root: HTMLElement;
  /** Takes another arm. */
  take(shown: Shown): void;
  /** The state has changed, or the section is shown from now on. Called only while it is shown. */
  update(q: number[], changed: ReadonlySet<keyof PageState>): void;
  /** Another section is shown from now on: takes its marks out of the picture. */
  leave(): void;
}
