import { element } from "../elements/element.js";

/** Where the documentation speaks of something: a link in the built documentation, which tells the page its place; elsewhere the
 * name of the file. */
export function documentOf(title: string, path: string): HTMLElement | string {
  const place = document.body.dataset["docs"];
  if (place === undefined) return `${title} (docs/${path}.md)`;
  return element("a", { href: `${place}/${path}.html`, target: "_top" }, title); // the page stands in a frame there
}
