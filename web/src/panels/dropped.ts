import type { PathFile } from "../scene/mesh_files.js";

const maxFiles = 2000; // of dropped folders

function fileOf(entry: FileSystemFileEntry): Promise<File> {
  return new Promise((resolve, reject) => entry.file(resolve, reject));
}

function someEntries(reader: FileSystemDirectoryReader): Promise<FileSystemEntry[]> {
  return new Promise((resolve, reject) => reader.readEntries(resolve, reject));
}

async function collect(entry: FileSystemEntry, into: PathFile[]): Promise<void> {
  if (into.length >= maxFiles) return;
  if (entry.isFile) into.push({ path: entry.fullPath, file: await fileOf(entry as FileSystemFileEntry) });
  if (!entry.isDirectory) return;
  const reader = (entry as FileSystemDirectoryEntry).createReader();
  for (let some = await someEntries(reader); some.length > 0; some = await someEntries(reader))
    for (const one of some) await collect(one, into);
}

/** Files with the paths of the folder that was chosen. */
export function filesOf(list: FileList | null): PathFile[] {
  return [...(list ?? [])].map((file) => ({ path: file.webkitRelativePath || file.name, file }));
}

/** All files that were dropped, also those in folders. */
export async function droppedFiles(transfer: DataTransfer): Promise<PathFile[]> {
  const files = filesOf(transfer.files); // both must be asked for before anything is awaited
  const entries = [...transfer.items].map((item) => item.webkitGetAsEntry?.() ?? null);
  if (!entries.some((entry) => entry?.isDirectory)) return files;
  const found: PathFile[] = [];
  for (const entry of entries) if (entry) await collect(entry, found);
  return found;
}
