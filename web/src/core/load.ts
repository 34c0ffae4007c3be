import type { CommandModule, Module } from "./module.js";
import { CoreError } from "./types.js";

/** The function that core.js and beeline.js export. */
export type Factory<M extends Module> = (options: object) => Promise<M>;

/** Bytes of modules that only validate where the browser has the feature. */
const header = [0, 97, 115, 109, 1, 0, 0, 0];
const type = [1, 4, 1, 96, 0, 0, 3, 2, 1, 0];
const features: [string, number[]][] = [
  // (func try catch_all end)
  ["exceptions", [...header, ...type, 10, 8, 1, 6, 0, 6, 64, 25, 11, 11]],
  // (func i32.const 0 i8x16.splat drop)
  ["128-bit SIMD", [...header, ...type, 10, 9, 1, 7, 0, 65, 0, 253, 15, 26, 11]],
];

/** What this browser lacks to run the core, in a sentence; null if it has everything. */
export function missingFeature(): string | null {
  if (typeof WebAssembly !== "object") return "This browser has no WebAssembly, which computes the motion.";
  const missing = features.filter(([, bytes]) => !WebAssembly.validate(new Uint8Array(bytes)));
  if (missing.length === 0) return null;
  const names = missing.map(([name]) => name).join(" and ");
  return `This browser's WebAssembly has no ${names}; Firefox 100, Chrome 95, Safari 16.4 and later have.`;
}

/** The bytes of a WebAssembly module, or the response of a server with them. */
export type Bytes = BufferSource | Response;

/** What `work` resolves to. An error becomes a CoreError with the code not_loaded. */
export async function loaded<T>(work: T | PromiseLike<T>): Promise<T> {
  try {
    return await work;
  } catch (error) {
    if (error instanceof CoreError) throw error;
    const why = error instanceof Error ? error.message : String(error);
    throw new CoreError(`The core cannot be loaded: ${why}`, "not_loaded");
  }
}

/** Compiles the module once; instantiate() makes instances of it. Throws CoreError with the code not_loaded. */
export function compile(bytes: Bytes | PromiseLike<Bytes>): Promise<WebAssembly.Module> {
  return loaded(compiled(bytes));
}

async function compiled(bytes: Bytes | PromiseLike<Bytes>): Promise<WebAssembly.Module> {
  const missing = missingFeature();
  if (missing !== null) throw new CoreError(missing, "not_loaded");
  const wasm = await bytes;
  if (wasm instanceof ArrayBuffer || ArrayBuffer.isView(wasm)) return WebAssembly.compile(wasm);
  if (!wasm.ok) throw new CoreError(`The core cannot be loaded: ${wasm.status} for ${wasm.url}`, "not_loaded");
  return WebAssembly.compile(await wasm.arrayBuffer());
}

/** Makes an instance with memory of its own. */
export function instantiate<M extends Module>(
  factory: Factory<M>,
  wasm: WebAssembly.Module,
  options: { preRun?: ((module: M) => void)[] } = {},
): Promise<M> {
  return new Promise((resolve, reject) => {
    const instantiateWasm = (imports: WebAssembly.Imports, done: (instance: WebAssembly.Instance) => void) => {
      WebAssembly.instantiate(wasm, imports).then(done, reject);
      return {};
    };
    factory({ ...options, instantiateWasm }).then(resolve, reject);
  });
}

/** The command's module, with files of its own. */
export function instantiateCommand(
  factory: Factory<CommandModule>,
  wasm: WebAssembly.Module,
  stdout: (byte: number) => void,
  stderr: (byte: number) => void,
): Promise<CommandModule> {
  const connect = ({ FS }: CommandModule): void => {
    FS.init(() => null, stdout, stderr);
  };
  return instantiate(factory, wasm, { preRun: [connect] });
}
