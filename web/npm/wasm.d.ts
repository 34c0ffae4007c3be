/** The modules of the folder wasm/ of the package. */
declare module "#wasm/*.js" {
  const factory: (options: object) => Promise<unknown>;
  export default factory;
}
