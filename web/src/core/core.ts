import { Arm } from "./arm.js";
import { requireFileNames } from "./files.js";
import { compile, instantiate, type Bytes, type Factory } from "./load.js";
import { readText, type CoreModule } from "./module.js";
import type { ChainEnds, Files } from "./types.js";

/** The small module, which computes while one drags: arms, kinematics, inverse kinematics, a PID controller. */
export class Core {
  private constructor(private readonly module: CoreModule) {}

  static async load(factory: Factory<CoreModule>, wasm: Bytes | PromiseLike<Bytes>): Promise<Core> {
    return new Core(await instantiate(factory, await compile(wasm)));
  }

  builtInNames(): string[] {
    return JSON.parse(readText(this.module, this.module._beeline_built_in_names())) as string[];
  }

  /** The arm of an argument ARM of the command line: a built-in name, a joint string with lengths, or the name of one
   * of `files`, .urdf or .json; a DH table is JSON. Throws CoreError with the command line's message. */
  arm(name: string, files: Files = {}, ends: ChainEnds = {}): Arm {
    requireFileNames(files);
    return new Arm(this.module, name, files[name] ?? null, ends);
  }
}
