import { CoreError, type InputFiles } from "./types.js";

/** Throws CoreError if a file's name has a folder or a leading dot. */
export function requireFileNames(files: InputFiles): void {
  for (const name of Object.keys(files)) {
    if (!/^[^/\0.][^/\0]*$/.test(name)) {
      throw new CoreError(`"${name}" is not the name of a file: it must have no folder and no leading dot`);
    }
  }
}
