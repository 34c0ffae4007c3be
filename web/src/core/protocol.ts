import type { ReachAnswers, ReachTask } from "./reach.js";
import type { CommandResult, Files } from "./types.js";

/** What the page posts to a worker: one command, answered by one result after any number of progress messages. */
export interface CommandRequest {
  id: number;
  args: string[];
  files: Files;
}

/** A question about a map of what an arm can do, answered as a command is. */
export interface ReachRequest {
  id: number;
  reach: ReachTask;
}

export type Request = CommandRequest | ReachRequest;

/** The first message to a worker: the compiled module of the command. */
export interface WorkerStart {
  module: WebAssembly.Module;
}

export type WorkerReply =
  | { id: number; progress: number }
  | { id: number; result: CommandResult | ReachAnswers[keyof ReachAnswers] }
  | { id: number; error: string };
