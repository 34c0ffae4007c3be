import { CoreError, type ErrorCode } from "./types.js";
import { inWords } from "./words.js";

/** What each of Emscripten's modules has of what we use, and the functions of web/core/memory.h. */
export interface Module {
  HEAPU8: Uint8Array;
  HEAP32: Int32Array;
  HEAPF32: Float32Array;
  HEAPF64: Float64Array;
  _malloc(bytes: number): number;
  _free(pointer: number): void;
  _beeline_allocate(count: number): number;
  _beeline_release(pointer: number): void;
  _beeline_error(): number;
}

/** The command's module, web/core/command.h, reach.h and scene.h. */
export interface CommandModule extends Module {
  FS: FileSystem;
  /** Called by _beeline_command() and _beeline_reach_compute() with the fraction computed. */
  progress(fraction: number): void;
  _beeline_command(argc: number, argv: number): number;
  _beeline_reach(arm: number, resolution: number, directions: number, rolls: number, orientation: number): number;
  _beeline_reach_grid(map: number, numbers: number): number;
  _beeline_reach_orientations(map: number, numbers: number): number;
  _beeline_reach_compute(map: number): number;
  _beeline_reach_values(map: number, measure: number): number;
  _beeline_reach_surface(map: number, values: number, count: number, level: number): number;
  _beeline_reach_vertex_count(map: number): number;
  _beeline_reach_vertices(map: number): number;
  _beeline_reach_triangles(map: number): number;
  _beeline_reach_release(map: number): number;
  _beeline_scene(arm: number, base: number, tip: number, clearance: number): number;
  _beeline_scene_links(scene: number): number;
  _beeline_scene_clearance(scene: number): number;
  _beeline_scene_read(scene: number, path: number): number;
  _beeline_scene_obstacles(scene: number, text: number): number;
  _beeline_scene_nearest(scene: number, ofLinks: number, q: number, numbers: number): number;
  _beeline_scene_guard(scene: number, slides: number, from: number, to: number, numbers: number): number;
  _beeline_scene_release(scene: number): number;
}

/** The core's module: the functions of web/core/beeline.h, with an underscore in front. */
export interface CoreModule extends Module {
  _beeline_arm(name: number, text: number, base: number, tip: number): number;
  _beeline_arm_json(arm: number): number;
  _beeline_arm_description(arm: number): number;
  _beeline_built_in_names(): number;
  _beeline_arm_release(arm: number): number;
  _beeline_arm_dof(arm: number): number;
  _beeline_arm_links(arm: number): number;
  _beeline_arm_planar(arm: number): number;
  _beeline_forward(arm: number, q: number, matrices: number): number;
  _beeline_display_configuration(arm: number, q: number): number;
  _beeline_skeleton(arm: number, q: number, numbers: number): number;
  _beeline_jacobian(arm: number, q: number, frame: number, columns: number): number;
  _beeline_manipulability(arm: number, q: number, measures: number): number;
  _beeline_inverse(
    arm: number,
    pose: number,
    seed: number,
    ignoreLimits: number,
    capacity: number,
    solutions: number,
  ): number;
  _beeline_pid(dof: number, kp: number, ki: number, kd: number, q: number, goal: number): number;
  _beeline_pid_step(pid: number, q: number): number;
  _beeline_pid_release(pid: number): number;
  _beeline_trajectory(arm: number, name: number, text: number): number;
  _beeline_trajectory_size(trajectory: number): number;
  _beeline_trajectory_columns(trajectory: number): number;
  _beeline_trajectory_values(trajectory: number, numbers: number): number;
  _beeline_trajectory_sample(trajectory: number, time: number, q: number): number;
  _beeline_trajectory_text(trajectory: number, name: number): number;
  _beeline_trajectory_release(trajectory: number): number;
}

export interface FileSystem {
  init(stdin: () => number | null, stdout: (byte: number) => void, stderr: (byte: number) => void): void;
  mkdir(path: string): void;
  chdir(path: string): void;
  readdir(path: string): string[];
  writeFile(path: string, content: string | Uint8Array): void;
  unlink(path: string): void;
  readFile(path: string, options: { encoding: "utf8" }): string;
}

/** Copies a text into the module's memory, with a zero byte behind it; free it with _free(). Throws CoreError for a text
 * with a zero character, which would end it, and where there is no memory for it. */
export function writeText(module: Module, text: string): number {
  if (typeof text !== "string") throw new CoreError(`${inWords(text)} is not a text`);
  if (text.includes("\0")) throw new CoreError(`the text ${inWords(text)} has a NUL character`);
  const bytes = new TextEncoder().encode(text);
  const pointer = module._malloc(bytes.length + 1);
  if (pointer === 0) throw new CoreError(`the core has no memory for a text of ${bytes.length} bytes`, "no_memory");
  module.HEAPU8.set(bytes, pointer);
  module.HEAPU8[pointer + bytes.length] = 0;
  return pointer;
}

/** Calls `work` with copies of texts, null as 0, and frees them. */
export function withTexts<T>(module: Module, texts: (string | null)[], work: (...pointers: number[]) => T): T {
  const pointers: number[] = [];
  try {
    for (const text of texts) pointers.push(text === null ? 0 : writeText(module, text));
    return work(...pointers);
  } finally {
    for (const pointer of pointers) module._free(pointer);
  }
}

export function readText(module: Module, pointer: number): string {
  const end = module.HEAPU8.indexOf(0, pointer);
  return new TextDecoder().decode(module.HEAPU8.slice(pointer, end));
}

/** The value that a function of the core has returned. Throws CoreError with the core's message where it is negative. */
export function checked(module: Module, value: number, code?: ErrorCode): number {
  if (value < 0) throw new CoreError(readText(module, module._beeline_error()), code);
  return value;
}
