import type { Plugin } from "vite";

/** Makes index.html ask for a file of the build at once, which its script would ask for later. `name`: without its hash. */
export function preload(name: string, ending: string): Plugin {
  return {
    name: "preload",
    transformIndexHtml: {
      order: "post",
      handler(_, { bundle = {} }) {
        const file = Object.keys(bundle).find((one) => one.startsWith(`assets/${name}-`) && one.endsWith(ending));
        if (!file) return [];
        const attrs = { rel: "preload", href: `./${file}`, as: "fetch", crossorigin: true };
        return [{ tag: "link", attrs, injectTo: "head" }];
      },
    },
  };
}
