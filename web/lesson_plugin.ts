import { Marked } from "marked";
import temml from "temml";
import type { Plugin } from "vite";

/** The lines below an exercise: "hint: …" and "solution: …", each hidden until it is asked for. */
function help(body: string): string {
  let hints = 0;
  return body
    .split(/^(?=hint:|solution:)/m)
    .flatMap((item) => {
      const [, kind, text = ""] = /^(hint|solution):([\s\S]*)$/.exec(item.trim()) ?? [];
      if (!kind) return [];
      const title = kind === "hint" ? `Hint ${++hints}` : "Solution";
      const html = new Marked().parseInline(text.trim(), { async: false });
      return `<details class="${kind}"><summary>${title}</summary><p>${html}</p></details>`;
    })
    .join("");
}

/** MathML without what browsers do by themselves; the page and each saved page carry it. */
function slim(math: string): string {
  return math
    .replace(/ class="tml-[^"]*"| style="[^"]*"| fence="true"| stretchy="true"/g, "")
    .replace(/ form="(?:prefix|postfix)"(?=[^>]*>[()[\]])/g, "")
    .replace(/<mo>\u2061<\/mo>/g, "")
    .replace(/<mspace width="0(\.\d\d)\d*em"><\/mspace>/g, '<mspace width="$1em"/>');
}

/** Turns a lesson into HTML: Markdown, with equations between $ or $$ as MathML, $$(1.3) … a numbered one, and exercises,
 * ```check NAME```, with hints and a solution, and figures, ```figure NAME```, as elements that the page fills. */
export function lessonHtml(text: string): string {
  const equations: string[] = [];
  const hold = (html: string): string => {
    equations.push(html);
    return `§${equations.length - 1}§`;
  };
  const typeset = (tex: string, displayMode: boolean): string =>
    slim(temml.renderToString(tex.trim(), { displayMode, throwOnError: true }));
  const held = text
    .replace(/\$\$(?:\((\d\.\d)\))?([^$]+)\$\$/g, (_, number: string | undefined, tex: string) =>
      hold(
        number === undefined
          ? typeset(tex, true)
          : `<span class="equation">${typeset(tex, true)}<span>(${number})</span></span>`,
      ),
    )
    .replace(/\$([^$]+)\$/g, (_, tex: string) => hold(typeset(tex, false)))
    .replace(
      /```(check|figure) (\S+)\s*?\n([\s\S]*?)```/g,
      (_, kind: string, name: string, body: string) => `<div data-${kind}="${name}">${help(body)}</div>`,
    );
  const html = new Marked().parse(held, { async: false });
  return html.replace(/§(\d+)§/g, (_, index: string) => equations[Number(index)] ?? "");
}

/** Imports of lessons, .md, are their HTML. */
export function lessons(): Plugin {
  return {
    name: "lessons",
    transform(code, id) {
      if (!id.endsWith(".md")) return null;
      return { code: `export default ${JSON.stringify(lessonHtml(code))};`, map: null };
    },
  };
}
