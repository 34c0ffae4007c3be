import { answer, command } from "./command.js";
import { compile, type Bytes, type Factory } from "./load.js";
import type { CommandModule } from "./module.js";
import type { CommandResult, InputFiles } from "./types.js";

/** The whole command line in this thread; CoreWorker runs it in another. */
export class Commands {
  private constructor(
    private readonly factory: Factory<CommandModule>,
    private readonly wasm: WebAssembly.Module,
  ) {}

  static async load(factory: Factory<CommandModule>, wasm: Bytes | PromiseLike<Bytes>): Promise<Commands> {
    return new Commands(factory, await compile(wasm));
  }

  /** Runs `beeline ARGS` with these files in its folder. */
  run(args: string[], files: InputFiles = {}, progress?: (fraction: number) => void): Promise<CommandResult> {
    return command(this.factory, this.wasm, args, files, progress);
  }

  /** Returns what `beeline ARGS --json` prints, also when the answer is no. Throws CoreError if the command is refused. */
  async json<T>(args: string[], files: InputFiles = {}): Promise<T> {
    return answer<T>(await this.run([...args, "--json"], files));
  }
}
