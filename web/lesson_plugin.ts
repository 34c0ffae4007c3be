import { Marked } from "marked";
import temml from "temml";
import type { Plugin } from "vite";

/** The text between the marks of a block, as HTML. */
const inline = (text: string): string => new Marked().parseInline(text.trim(), { async: false });

/** An exercise: its task; "paper: …", the task as a worksheet has it where the page is needed for the other; "draw: …", what
 * the worksheet draws; then "hint: …" and "solution: …", each hidden until it is asked for. */
function exercise(body: string): string {
  let hints = 0;
  return body
    .split(/^(?=(?:paper|draw|hint|solution):)/m)
    .map((item) => {
      const [, kind = "task", text = item] = /^(paper|draw|hint|solution):([\s\S]*)$/.exec(item.trim()) ?? [];
      if (kind === "draw") return `<template data-draw="${text.trim()}"></template>`;
      if (kind === "task" || kind === "paper") return text.trim() && `<p class="${kind}">${inline(text)}</p>`;
      const title = kind === "hint" ? `Hint ${++hints}` : "Solution";
      return `<details class="${kind}"><summary>${title}</summary><p>${inline(text)}</p></details>`;
    })
    .join("");
}

/** The statements of a lesson and where each comes from, a line each: "statement | source". */
function sources(body: string): string {
  const rows = body
    .trim()
    .split("\n")
    .map((line) => line.split(" | ").map(inline));
  const items = rows.map(([statement = "", source = ""]) => `<dt>${statement}</dt><dd>${source}</dd>`);
  return `<summary>Sources of each statement</summary><dl>${items.join("")}</dl>`;
}

/** MathML without what browsers do by themselves; the page and each saved page carry it. */
function slim(math: string): string {
  return math
    .replace(/ class="tml-[^"]*"| style="[^"]*"| fence="true"| stretchy="true"/g, "")
    .replace(/ form="(?:prefix|postfix)"(?=[^>]*>[()[\]])/g, "")
    .replace(/<mo>\u2061<\/mo>/g, "")
    .replace(/<mspace width="0(\.\d\d)\d*em"><\/mspace>/g, '<mspace width="$1em"/>');
}

/** Turns a lesson into HTML: Markdown, with equations between $ or $$ as MathML, $$(1.3) … a numbered one; exercises,
 * ```check NAME```, figures, ```figure NAME```, and tools, ```tool NAME```, as elements that the page fills; ```sources```.
 * Sessions of the documents are left out: they are for a shell. */
export function lessonHtml(text: string): string {
  const equations: string[] = [];
  const hold = (html: string): string => {
    equations.push(html);
    return `§${equations.length - 1}§`;
  };
  const typeset = (tex: string, displayMode: boolean): string =>
    slim(temml.renderToString(tex.trim(), { displayMode, throwOnError: true }));
  const held = text
    .replace(/:\n\n(?=```(?:console|pycon|\{))/g, ".\n\n")
    .replace(/```(?:console|pycon|\{code-block\}[^\n]*)\n[\s\S]*?```\n/g, "")
    .replace(/\$\$(?:\((\d\.\d)\))?([^$]+)\$\$/g, (_, number: string | undefined, tex: string) =>
      hold(
        number === undefined
          ? typeset(tex, true)
          : `<span class="equation">${typeset(tex, true)}<span>(${number})</span></span>`,
      ),
    )
    .replace(/\$([^$]+)\$/g, (_, tex: string) => hold(typeset(tex, false)))
    .replace(/```sources\n([\s\S]*?)```/g, (_, body: string) => `<details class="sources">${sources(body)}</details>`)
    .replace(
      /```(check|figure|tool) (\S+)\s*?\n([\s\S]*?)```/g,
      (_, kind: string, name: string, body: string) => `<div data-${kind}="${name}">${exercise(body)}</div>`,
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
