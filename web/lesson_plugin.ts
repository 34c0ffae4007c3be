import { Marked } from "marked";
import temml from "temml";
import type { Plugin } from "vite";

/** Turns a lesson into HTML: Markdown, with equations between $ or $$ as MathML, and exercises, ```check NAME```, and
 * figures, ```figure NAME```, as elements that the page fills. */
export function lessonHtml(text: string): string {
  const equations: string[] = [];
  const hold = (tex: string, displayMode: boolean): string => {
    equations.push(temml.renderToString(tex.trim(), { displayMode, throwOnError: true }));
    return `§${equations.length - 1}§`;
  };
  const held = text
    .replace(/\$\$([^$]+)\$\$/g, (_, tex: string) => hold(tex, true))
    .replace(/\$([^$]+)\$/g, (_, tex: string) => hold(tex, false))
    .replace(/```(check|figure) (\S+)\s*```/g, (_, kind: string, name: string) => `<div data-${kind}="${name}"></div>`);
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
