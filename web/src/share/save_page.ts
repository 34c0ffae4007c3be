import { elementOf, parts, savedText } from "./parts.js";

const state = "saved-state";

/** The part of the address behind # that a saved page begins with; empty in other pages. */
export function savedAddress(): string {
  return document.getElementById(state)?.textContent?.trim() ?? "";
}

async function textAt(address: string): Promise<string> {
  const answer = await fetch(address);
  if (!answer.ok) throw new Error(`${answer.url}: ${answer.status}`);
  return answer.text();
}

/** Code and style of the page: in a saved page its own elements, else files. */
async function codeAndStyle(): Promise<{ code: string; style: string }> {
  const script = document.querySelector<HTMLScriptElement>('script[type="module"]');
  const sheet = document.querySelector<HTMLLinkElement>('link[rel="stylesheet"]');
  return {
    code: script?.src ? await textAt(script.src) : (script?.textContent ?? ""),
    style: sheet ? await textAt(sheet.href) : (document.querySelector("style")?.textContent ?? ""),
  };
}

/** The whole page as one HTML document, which opens from a disk without a network and shows what `address` (behind #)
 * says. */
export async function pageAsDocument(address: string): Promise<string> {
  const { code, style } = await codeAndStyle();
  const held = await Promise.all(
    parts.map(async (part) => `<script type="text/plain" id="${elementOf(part)}">${await savedText(part)}</script>`),
  );
  const escaped = address.replaceAll("&", "&amp;").replaceAll("<", "&lt;");
  return [
    '<!doctype html><html lang="en"><head><meta charset="utf-8">',
    '<meta name="viewport" content="width=device-width, initial-scale=1"><title>Beeline</title>',
    `<link rel="icon" href="data:,"><style>${style}</style></head><body>`,
    `<p id="${state}" hidden>${escaped}</p>`,
    '<header><h1>Beeline</h1><nav aria-label="Sections" id="sections"></nav></header>',
    '<main><section id="view" aria-label="Picture of the arm"><div id="stage"></div>',
    '<div id="tools" role="toolbar" aria-label="Picture"></div>',
    '<p id="first" role="status">Loading the core …</p></section>',
    '<section id="side" aria-label="Panel"></section></main>',
    ...held,
    `<script type="module">${code.replaceAll("</script", "<\\/script")}</script>`,
    "</body></html>",
  ].join("\n");
}
