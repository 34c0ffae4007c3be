import { Arm } from "./arm.js";
import { namesFile, requireFiles, textOf } from "./files.js";
import { compile, instantiate, type Bytes, type Factory } from "./load.js";
import { readText, type CoreModule } from "./module.js";
import { CoreError, type ChainEnds, type InputFiles } from "./types.js";
import { inWords } from "./words.js";

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
  arm(name: string, files: InputFiles = {}, ends: ChainEnds = {}): Arm {
    if (typeof name !== "string") throw new CoreError(`the arm is ${inWords(name)}; it must be a text`);
    requireFiles(files);
    const text = textOf(files, name);
    if (text === null && namesFile(name)) {
      throw new CoreError(`${name}: no such file; give its text in files`, "invalid_arm");
    }
    return new Arm(this.module, name, text, ends);
  }
}
