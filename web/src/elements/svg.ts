const space = "http://www.w3.org/2000/svg";
type Attributes = Record<string, string | number>;

/** Makes an element of a drawing. */
export function svg<K extends keyof SVGElementTagNameMap>(
  tag: K,
  attributes: Attributes = {},
  ...children: (Node | string)[]
): SVGElementTagNameMap[K] {
  const made = document.createElementNS(space, tag);
  set(made, attributes);
  made.append(...children);
  return made;
}

export function set(part: SVGElement, attributes: Attributes): void {
  for (const [name, value] of Object.entries(attributes)) part.setAttribute(name, String(value));
}

/** The children of a group, as many as wanted: the first ones stay, so that nothing flickers. */
export function children<E extends SVGElement>(group: SVGElement, count: number, make: (index: number) => E): E[] {
  while (group.childElementCount > count) group.lastElementChild?.remove();
  for (let i = group.childElementCount; i < count; ++i) group.append(make(i));
  return [...group.children] as E[];
}

/** A path through points, pixels. */
export function pathOf(points: readonly (readonly [number, number])[]): string {
  return points.map(([x, y], i) => `${i === 0 ? "M" : "L"}${x.toFixed(2)} ${y.toFixed(2)}`).join("");
}

/** Dots as lines without length, which round caps make visible. */
export function dotsOf(points: readonly (readonly [number, number])[]): string {
  return points.map(([x, y]) => `M${x.toFixed(2)} ${y.toFixed(2)}h0`).join("");
}

/** An arrow as two paths: its line, which ends inside the head, and its head. */
export function arrowOf(
  [x1, y1]: readonly [number, number],
  [x2, y2]: readonly [number, number],
  head: number,
): { line: string; head: string } {
  const length = Math.hypot(x2 - x1, y2 - y1) || 1;
  const [ux, uy] = [(x2 - x1) / length, (y2 - y1) / length];
  const at = (along: number, beside: number): [number, number] => [
    x2 - along * ux - beside * uy,
    y2 - along * uy + beside * ux,
  ];
  const tip: [number, number] = [x2, y2];
  return {
    line: pathOf([[x1, y1], at(0.85 * head, 0)]),
    head: `${pathOf([tip, at(head, 0.38 * head), at(0.8 * head, 0), at(head, -0.38 * head)])}Z`,
  };
}
