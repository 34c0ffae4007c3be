import { deflateRawSync } from "node:zlib";
import type { Plugin } from "vite";

const empty = (name: string, more = ""): string => `<script type="text/plain" id="saved-${name}"${more}></script>`;

/** Runs the page's code, which is deflated, in base64, in an element of the document. The script that does is not left in the
 * document, whose text a page saved from this one has. */
const start = `<script type="module">
const text = atob(document.getElementById("saved-code").textContent);
const bytes = Uint8Array.from(text, (letter) => letter.charCodeAt(0));
const code = new Blob([bytes]).stream().pipeThrough(new DecompressionStream("deflate-raw"));
const script = Object.assign(document.createElement("script"), { type: "module" });
script.textContent = await new Response(code).text();
document.body.append(script);
script.remove();
</script>`;

/** Makes the page one document, saved.html: its code, deflated, and style inside, and an empty element for each part that is loaded
 * when it runs, with the part's file in `data-file`. Whoever writes a saved page replaces ` data-file="FILE">` by `>` and
 * the file's content, deflated, in base64 (src/share/save_page.ts, the Python module); the elements of the state and of
 * the trajectory hold what the page begins with. `parts`: name -> name of the file without its hash. */
export function savedPage(parts: Record<string, string>): Plugin {
  return {
    name: "saved-page",
    generateBundle: {
      order: "post", // after Vite's own changes of the chunks
      handler(_, bundle) {
        const files = Object.values(bundle);
        const chunks = files.filter((file) => file.type === "chunk");
        const style = files.find(({ fileName }) => fileName.endsWith(".css"));
        const html = bundle["index.html"];
        const [code] = chunks;
        if (chunks.length !== 1 || !code || style?.type !== "asset" || html?.type !== "asset")
          this.error(`saved.html needs one script and one style sheet; there are ${Object.keys(bundle).join(", ")}`);
        const held = Object.entries(parts).map(([part, name]) => {
          const file = files.find(({ fileName }) => fileName.startsWith(`assets/${name}-`))?.fileName;
          if (!file) this.error(`saved.html: no file of the part ${part}`);
          return empty(part, ` data-file="${file}"`);
        });
        const text = String(html.source)
          .replace(/<script type="module"[^>]*><\/script>/, "")
          .replace(/<link rel="stylesheet"[^>]*>/, () => `<style>${String(style.source)}</style>`)
          .replace("</body>", () => {
            const packed = deflateRawSync(code.code, { level: 9 }).toString("base64");
            const script = `<script type="text/plain" id="saved-code">${packed}</script>`;
            return [empty("state"), empty("trajectory"), ...held, script, start, "</body>"].join("\n");
          });
        // The build of the page has written the other files.
        for (const { fileName } of files) delete bundle[fileName];
        this.emitFile({ type: "asset", fileName: "saved.html", source: text });
      },
    },
  };
}
