import { standalone } from "../standalone.js";

const magnified = 2;

/** A drawing as a PNG, on the ground that it has in the page. */
export async function pngOf(drawing: SVGSVGElement): Promise<Blob | null> {
  const { width, height } = drawing.getBoundingClientRect();
  const image = await standalone(drawing);
  const canvas = document.createElement("canvas");
  [canvas.width, canvas.height] = [magnified * width, magnified * height];
  const context = canvas.getContext("2d");
  if (!context) return null;
  context.fillStyle = getComputedStyle(drawing).backgroundColor;
  context.fillRect(0, 0, canvas.width, canvas.height);
  context.drawImage(image, 0, 0, canvas.width, canvas.height);
  return new Promise((resolve) => canvas.toBlob(resolve, "image/png"));
}
