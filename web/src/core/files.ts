import { CoreError, type InputFiles } from "./types.js";
import { inWords } from "./words.js";

/** Throws CoreError if `files` are not contents by name, or if a file's name has a folder or a leading dot. */
export function requireFiles(files: InputFiles): void {
  if (typeof files !== "object" || files === null) {
    throw new CoreError(`files is ${inWords(files)}; it must be an object of contents by name`);
  }
  for (const [name, content] of Object.entries(files)) {
    if (!/^[^/\0.][^/\0]*$/.test(name)) {
      throw new CoreError(`${inWords(name)} is not the name of a file: it must have no folder and no leading dot`);
    }
    if (typeof content !== "string" && !(content instanceof Uint8Array)) {
      throw new CoreError(`the file ${name} is ${inWords(content)}; it must be a text or a Uint8Array`);
    }
  }
}

/** The text of a file; null if it is not one of these. Bytes are UTF-8. */
export function textOf(files: InputFiles, name: string): string | null {
  const content = Object.hasOwn(files, name) ? (files[name] ?? "") : null;
  return content instanceof Uint8Array ? new TextDecoder().decode(content) : content;
}

/** Whether an argument ARM of the command line names a file, as read_arm() in beeline/io/text/arm.cpp decides: a dot or a
 * slash is in it, and it is no joint string with lengths. */
export function namesFile(arm: string): boolean {
  return /[./]/.test(arm) && !/^[A-Z]+:/.test(arm);
}
