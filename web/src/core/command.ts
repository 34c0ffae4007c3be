import { requireFiles } from "./files.js";
import { instantiateCommand, type Factory } from "./load.js";
import { readText, writeText, type CommandModule } from "./module.js";
import { CoreError, type CommandResult, type Files, type InputFiles } from "./types.js";
import { inWords } from "./words.js";

/** Collects a stream's bytes. */
class Collected {
  private readonly bytes: number[] = [];

  readonly put = (byte: number): void => {
    this.bytes.push(byte & 255);
  };

  text(): string {
    return new TextDecoder().decode(new Uint8Array(this.bytes));
  }
}

const folder = "/work";

function prepare(module: CommandModule, files: InputFiles): void {
  requireFiles(files);
  module.FS.mkdir(folder);
  module.FS.chdir(folder);
  for (const [name, content] of Object.entries(files)) module.FS.writeFile(name, content);
}

function written(module: CommandModule, given: InputFiles): Files {
  const files: Files = {};
  for (const name of module.FS.readdir(folder)) {
    if (name === "." || name === ".." || given[name] instanceof Uint8Array) continue; // a mesh was only read
    const text = module.FS.readFile(name, { encoding: "utf8" });
    if (given[name] !== text) files[name] = text;
  }
  return files;
}

function call(module: CommandModule, args: string[]): number {
  const texts = ["beeline", ...args].map((text) => writeText(module, text));
  const argv = module._malloc(4 * (texts.length + 1));
  module.HEAP32.set([...texts, 0], argv / 4);
  return module._beeline_command(texts.length, argv);
}

/** Runs `beeline ARGS` in an instance of its own, with these files in its folder. The instance is dropped with all
 * that it holds when the command ends. */
export async function command(
  factory: Factory<CommandModule>,
  wasm: WebAssembly.Module,
  args: string[],
  files: InputFiles = {},
  progress: (fraction: number) => void = () => undefined,
): Promise<CommandResult> {
  const stdout = new Collected();
  const stderr = new Collected();
  const module = await instantiateCommand(factory, wasm, stdout.put, stderr.put);
  module.progress = progress;
  prepare(module, files);
  const code = call(module, args);
  const refusal = readText(module, module._beeline_error());
  return { code, stdout: stdout.text(), stderr: stderr.text(), refusal, files: written(module, files) };
}

/** The JSON that a command with --json prints. Throws CoreError with the message of a command that was refused, or that has
 * printed something else, as with --help. */
export function answer<T = unknown>(result: CommandResult): T {
  if (result.code > 1) throw new CoreError(result.refusal, result.code === 3 ? "invalid_file" : "invalid_usage");
  try {
    return JSON.parse(result.stdout) as T;
  } catch {
    const first = result.stdout.slice(0, Math.max(0, result.stdout.indexOf("\n")));
    throw new CoreError(`the command printed ${inWords(first)} in place of JSON`, "invalid_usage");
  }
}
