import { tooLarge } from "../core/limits.js";
import { baseName, type PathFile } from "../scene/mesh_files.js";

/** The file of obstacles among files that were dropped or chosen; null: there is none. A JSON file is one if it has a list of
 * obstacles, or the world of a scene of MoveIt. */
export async function sceneAmong(files: PathFile[]): Promise<File | null> {
  for (const { path, file } of files) {
    if (/\.(scene|ya?ml)$/i.test(path)) return file;
    const isRead = /\.json$/i.test(path) && tooLarge(file) === null;
    if (isRead && hasObstacles(await file.text().catch(() => ""))) return file;
  }
  return null;
}

function hasObstacles(text: string): boolean {
  try {
    const read: unknown = JSON.parse(text);
    return typeof read === "object" && read !== null && ("obstacles" in read || "world" in read);
  } catch {
    return false;
  }
}

/** A URDF text whose collision meshes are files beside it, as far as they are among `files`, with these files. */
export async function withCollisionMeshes(
  urdf: string,
  fileAt: (path: string) => PathFile | null,
): Promise<{ text: string; files: Record<string, Uint8Array> }> {
  const document = new DOMParser().parseFromString(urdf, "text/xml");
  const meshes = [...document.querySelectorAll("link > collision > geometry > mesh[filename]")];
  const paths = new Set(meshes.map((mesh) => mesh.getAttribute("filename") ?? ""));
  const files: Record<string, Uint8Array> = {};
  let text = urdf;
  for (const path of paths) {
    const found = fileAt(path);
    if (!found) continue; // the reader says which is missing
    const name = `${Object.keys(files).length + 1}_${baseName(found.path)}`;
    files[name] = new Uint8Array(await found.file.arrayBuffer());
    text = text.replaceAll(`"${path}"`, `"${name}"`).replaceAll(`'${path}'`, `'${name}'`);
  }
  return { text, files };
}
