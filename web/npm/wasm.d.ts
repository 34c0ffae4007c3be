/** The modules of the folder wasm/ of the package. */
declare module "#wasm/core.js" {
  const factory: import("../src/core/load.js").Factory<import("../src/core/module.js").CoreModule>;
  export default factory;
}
declare module "#wasm/beeline.js" {
  const factory: import("../src/core/load.js").Factory<import("../src/core/module.js").CommandModule>;
  export default factory;
}
