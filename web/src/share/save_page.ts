import { compressed, decompressed } from "../address/compression.js";
import { savedText } from "./parts.js";

/** A saved page as it was opened, before anything changed it; null in other pages. */
const asOpened = savedText("state") === null ? null : `<!doctype html>\n${document.documentElement.outerHTML}`;

/** The part of the address behind # that a saved page begins with; empty in other pages. */
export function savedAddress(): string {
  return savedText("state") ?? "";
}

/** The trajectory, CSV, that a saved page begins with; null where it has none. */
export async function savedTrajectory(): Promise<string | null> {
  const text = savedText("trajectory");
  return text === null ? null : new TextDecoder().decode(await decompressed(text));
}

async function fetched(address: string): Promise<Response> {
  const answer = await fetch(address);
  if (!answer.ok) throw new Error(`${answer.url}: ${answer.status}`);
  return answer;
}

/** saved.html with the files of the parts in its elements. */
async function documentWithParts(): Promise<string> {
  const text = await (await fetched("saved.html")).text();
  const [begin = "", ...parts] = text.split(/ data-file="(?=[^"]+"><\/script>)/);
  const filled = parts.map(async (part) => {
    const name = part.slice(0, part.indexOf('"'));
    const bytes = new Uint8Array(await (await fetched(name)).arrayBuffer());
    return `>${await compressed(bytes)}${part.slice(name.length + 2)}`;
  });
  return [begin, ...(await Promise.all(filled))].join("");
}

/** The whole page as one HTML document, which opens from a disk without a network and shows what `address` (behind #)
 * says. The Python module and `beeline view --save` make the same. */
export async function pageAsDocument(address: string): Promise<string> {
  const text = asOpened ?? (await documentWithParts());
  return text
    .replace(/(<body[^>]*) data-docs="[^"]*"/, "$1") // the documentation is not beside the file
    .replace(/(<script type="text\/plain" id="saved-state">)[^<]*/, (_, begin: string) => begin + address);
}
