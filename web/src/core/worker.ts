import { command } from "./command.js";
import type { Factory } from "./load.js";
import type { CommandModule } from "./module.js";
import type { CommandRequest, WorkerReply, WorkerStart } from "./protocol.js";

/** What serve() uses of a worker's global scope. */
export interface Scope {
  onmessage: ((event: MessageEvent<WorkerStart | CommandRequest>) => void) | null;
  postMessage(message: WorkerReply): void;
}

/** Answers the commands that the page posts behind the module, one after another. */
export function serve(scope: Scope, factory: Factory<CommandModule>): void {
  let module: WebAssembly.Module | null = null;
  const reply = (message: WorkerReply): void => scope.postMessage(message);
  const run = async ({ id, args, files }: CommandRequest): Promise<void> => {
    try {
      if (!module) throw new Error("a worker needs its module first");
      const result = await command(factory, module, args, files, (progress) => reply({ id, progress }));
      reply({ id, result });
    } catch (error) {
      reply({ id, error: error instanceof Error ? error.message : String(error) });
    }
  };
  let last = Promise.resolve();
  scope.onmessage = ({ data }: MessageEvent<WorkerStart | CommandRequest>) => {
    if ("module" in data) module = data.module;
    else last = last.then(() => run(data));
  };
}
