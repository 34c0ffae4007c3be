import type { SpatialPicture } from "./spatial/spatial_picture.js";

/** The picture of spatial arms, which is loaded when the first one is shown. */
export async function spatialPicture(): Promise<typeof SpatialPicture> {
  try {
    return (await import("./spatial/spatial_picture.js")).SpatialPicture;
  } catch {
    throw new Error("The picture of spatial arms cannot be loaded: reload the page."); // a browser does not ask twice
  }
}
