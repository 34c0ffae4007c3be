type Child = Node | string;
type Attributes = Record<string, string | number | boolean | EventListener>;

/** Makes an element: attributes by name, `on…` are listeners, true is an attribute without value, false none. */
export function element<K extends keyof HTMLElementTagNameMap>(
  tag: K,
  attributes: Attributes = {},
  ...children: Child[]
): HTMLElementTagNameMap[K] {
  const made = document.createElement(tag);
  for (const [name, value] of Object.entries(attributes)) {
    if (typeof value === "function") made.addEventListener(name.slice(2), value);
    else if (value === true) made.setAttribute(name, "");
    else if (value !== false) made.setAttribute(name, String(value));
  }
  made.append(...children);
  return made;
}

/** A table with a caption and a header row, unless they are empty, and a header in front of each row. */
export function table(caption: string, header: string[], labels: string[], rows: string[][]): HTMLTableElement {
  const titles = header.map((text) => (text === "" ? element("td") : element("th", { scope: "col" }, text)));
  const head = header.length > 0 ? [element("thead", {}, element("tr", {}, element("td"), ...titles))] : [];
  const body = rows.map((cells, i) => {
    const label = element("th", { scope: "row" }, labels[i] ?? "");
    return element("tr", {}, label, ...cells.map((cell) => element("td", {}, cell)));
  });
  const above = caption === "" ? [] : [element("caption", {}, caption)];
  return element("table", {}, ...above, ...head, element("tbody", {}, ...body));
}

/** A number as a field holds it: never -0. */
export function typed(value: number, digits: number): string {
  return shown(value, digits).replace("−", "-");
}

/** A number with few digits, as `beeline` shows it in texts. */
export function shown(value: number, digits = 4): string {
  if (!Number.isFinite(value)) return "∞";
  const rounded = Math.abs(value) < 0.5 * 10 ** -digits ? 0 : value;
  return rounded.toFixed(digits).replace("-", "−");
}
