import { standalone } from "../standalone.js";

/** A picture with what is written over it, as a PNG. */
export async function pngOf(picture: HTMLCanvasElement, over: SVGSVGElement): Promise<Blob | null> {
  const canvas = document.createElement("canvas");
  [canvas.width, canvas.height] = [picture.width, picture.height];
  const context = canvas.getContext("2d");
  if (!context) return null;
  context.drawImage(picture, 0, 0);
  context.drawImage(await standalone(over), 0, 0, canvas.width, canvas.height);
  return new Promise((resolve) => canvas.toBlob(resolve, "image/png"));
}
