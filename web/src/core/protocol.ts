import type { ReachAnswers, ReachTask } from "./reach.js";
import type { SceneAnswers, SceneTask } from "./scene.js";
import type { CommandResult, InputFiles } from "./types.js";

/** What the page posts to a worker: one command, answered by one result after any number of progress messages. */
export interface CommandRequest {
  id: number;
  args: string[];
  files: InputFiles;
}

/** A question about a map of what an arm can do, answered as a command is. */
export interface ReachRequest {
  id: number;
  reach: ReachTask;
}

/** A question about an arm among obstacles, answered as a command is. */
export interface SceneRequest {
  id: number;
  scene: SceneTask;
}

export type Request = CommandRequest | ReachRequest | SceneRequest;

/** The first message to a worker: the compiled module of the command. */
export interface WorkerStart {
  module: WebAssembly.Module;
}

export type WorkerReply =
  | { id: number; progress: number }
  | { id: number; result: CommandResult | ReachAnswers[keyof ReachAnswers] | SceneAnswers[keyof SceneAnswers] }
  | { id: number; error: string };
