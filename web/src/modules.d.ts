declare module "beeline-module/*.js" {
  const factory: (options: object) => Promise<unknown>;
  export default factory;
}
declare module "*.md" {
  const html: string;
  export default html;
}
declare module "*?url" {
  const url: string;
  export default url;
}
declare module "virtual:arms" {
  const arms: import("./panels/gallery.js").ListedArm[];
  export default arms;
}
declare module "virtual:opening" {
  /** Joint values, rad, of the motion with which the page opens. */
  const rows: number[][];
  export default rows;
}
