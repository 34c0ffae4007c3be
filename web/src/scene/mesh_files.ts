/** A file that was dropped or chosen, with its path where its folder was. */
export interface PathFile {
  path: string;
  file: File;
}

/** The mesh files of all visuals in a URDF text, as it names them. */
export function visualMeshes(urdf: string): string[] {
  const document = new DOMParser().parseFromString(urdf, "text/xml");
  const meshes = document.querySelectorAll("link > visual > geometry > mesh[filename]");
  return [...new Set([...meshes].map((mesh) => mesh.getAttribute("filename") ?? ""))];
}

/** Whether a file is part of what a URDF shows: a mesh, or a picture on it. */
export function isMeshFile(name: string): boolean {
  return /\.(stl|dae|obj|png|jpe?g|tga|bmp|gif|webp)$/i.test(name);
}

function parts(path: string): string[] {
  return path
    .replace(/^[a-z]+:\/\//i, "")
    .split(/[\\/]+/)
    .map((part) => decoded(part).toLowerCase())
    .filter((part) => part !== "" && part !== ".");
}

function decoded(text: string): string {
  try {
    return decodeURIComponent(text);
  } catch {
    return text;
  }
}

/** The file that a URDF or a mesh names by a path: of those with its name the one whose folders agree best. */
export function fileAt(path: string, files: PathFile[]): PathFile | null {
  const wanted = parts(path).reverse();
  let best: PathFile | null = null;
  let most = 0;
  for (const file of files) {
    const found = parts(file.path).reverse();
    let same = 0;
    while (same < wanted.length && wanted[same] === found[same]) ++same;
    if (same > most) [best, most] = [file, same];
  }
  return best;
}

/** The last part of a path. */
export function baseName(path: string): string {
  return path.split(/[\\/]/).at(-1) ?? path;
}
