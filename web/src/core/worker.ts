import { command } from "./command.js";
import { instantiateCommand, type Factory } from "./load.js";
import type { CommandModule } from "./module.js";
import type { Request, WorkerReply, WorkerStart } from "./protocol.js";
import { ReachModule } from "./reach_module.js";
import { SceneModule } from "./scene_module.js";

/** What serve() uses of a worker's global scope. */
export interface Scope {
  onmessage: ((event: MessageEvent<WorkerStart | Request>) => void) | null;
  postMessage(message: WorkerReply): void;
}

const ignore = (): void => undefined;

/** Answers the requests that the page posts behind the module, one after another. */
export function serve(scope: Scope, factory: Factory<CommandModule>): void {
  let module: WebAssembly.Module | null = null;
  const reply = (message: WorkerReply): void => scope.postMessage(message);
  let maps: Promise<ReachModule> | null = null; // an instance for all maps
  let scenes: Promise<SceneModule> | null = null; // and one for the arm among obstacles
  const run = async (request: Request): Promise<void> => {
    const { id } = request;
    try {
      if (!module) throw new Error("a worker needs its module first");
      const report = (progress: number): void => reply({ id, progress });
      if ("args" in request) {
        reply({ id, result: await command(factory, module, request.args, request.files, report) });
      } else if ("scene" in request) {
        scenes ??= instantiateCommand(factory, module, ignore, ignore).then((instance) => new SceneModule(instance));
        reply({ id, result: (await scenes).answer(request.scene) });
      } else {
        maps ??= instantiateCommand(factory, module, ignore, ignore).then((instance) => new ReachModule(instance));
        reply({ id, result: (await maps).answer(request.reach, report) });
      }
    } catch (error) {
      if ("reach" in request) maps = null; // it may have been left in the middle
      reply({ id, error: error instanceof Error ? error.message : String(error) });
    }
  };
  let last = Promise.resolve();
  scope.onmessage = ({ data }: MessageEvent<WorkerStart | Request>) => {
    if ("module" in data) module = data.module;
    else last = last.then(() => run(data));
  };
}
