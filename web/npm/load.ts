import factory from "#wasm/core.js";
import { Commands } from "../src/core/commands.js";
import { Core } from "../src/core/core.js";
import { Beeline } from "./beeline.js";

/** The bytes of a WebAssembly module, or the response of a server with them. */
type Module = () => Promise<BufferSource | Response>;

export async function load(core: Module, command: Module): Promise<Beeline> {
  const commands = async (): Promise<Commands> =>
    Commands.load((await import("#wasm/beeline.js")).default as never, await command());
  return new Beeline(await Core.load(factory as never, await core()), commands);
}
