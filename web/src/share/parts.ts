import coreUrl from "beeline-module/core.wasm?url";
import commandUrl from "beeline-module/beeline.wasm?url";
import workerUrl from "../core/command_worker.ts?worker&url";
import { decompressed } from "../address/compression.js";

/** The parts of the page that are loaded when it runs. In a saved page they are elements of the document, in base64. */
const addresses = { "core-module": coreUrl, "command-module": commandUrl, worker: workerUrl };
type Part = keyof typeof addresses;

/** The text of an element of a saved page (saved.html), such as a part; null in other pages and where it is empty. */
export function savedText(name: string): string | null {
  return document.getElementById(`saved-${name}`)?.textContent?.trim() || null;
}

/** The bytes of a part, from the document or from the server. */
export async function bytesOf(part: Part): Promise<Uint8Array> {
  const saved = savedText(part);
  if (saved !== null) return decompressed(saved);
  const answer = await fetch(addresses[part]);
  if (!answer.ok) throw new Error(`The page cannot be loaded: ${answer.status} for ${answer.url}`);
  return new Uint8Array(await answer.arrayBuffer());
}

/** The address of the worker's code in a saved page: made once, as each cancelled command starts another worker. */
let savedWorker = "";

/** Starts the worker that runs commands. Pages from a disk can start classic workers only, which have no import.meta. */
export async function startWorker(): Promise<Worker> {
  if (savedText("worker") === null) return new Worker(workerUrl, { type: "module" });
  if (savedWorker === "") {
    const code = new TextDecoder().decode(await bytesOf("worker")).replaceAll("import.meta", '({ url: "file:///" })');
    savedWorker = URL.createObjectURL(new Blob([code], { type: "text/javascript" }));
  }
  return new Worker(savedWorker);
}
