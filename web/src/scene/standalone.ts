const styles = [
  "display",
  "fill",
  "fill-opacity",
  "stroke",
  "stroke-width",
  "stroke-opacity",
  "stroke-dasharray",
  "stroke-linecap",
  "stroke-linejoin",
  "paint-order",
  "opacity",
  "font",
  "text-anchor",
  "image-rendering",
];

/** A drawing as it is seen, with the styles of the page in its elements, as an image. */
export async function standalone(drawing: SVGSVGElement): Promise<HTMLImageElement> {
  const copy = drawing.cloneNode(true) as SVGSVGElement;
  const copies = [...copy.querySelectorAll<SVGElement>("*")];
  drawing.querySelectorAll<SVGElement>("*").forEach((part, i) => {
    const style = getComputedStyle(part);
    const text = styles.map((name) => `${name}: ${style.getPropertyValue(name)}`).join("; ");
    copies[i]?.setAttribute("style", text);
  });
  for (const hidden of copy.querySelectorAll(".handle, .grip")) hidden.remove();
  const image = new Image();
  image.src = `data:image/svg+xml;charset=utf-8,${encodeURIComponent(new XMLSerializer().serializeToString(copy))}`;
  await image.decode();
  return image;
}
