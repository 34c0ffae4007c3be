import factory from "#wasm/core.js";
import { Commands } from "../src/core/commands.js";
import { Core } from "../src/core/core.js";
import { loaded, type Bytes } from "../src/core/load.js";
import { Beeline } from "./beeline.js";

/** Reads a WebAssembly module. */
type ModuleSource = () => Promise<Bytes>;

/** Loads the core; the command is loaded at its first call. */
export async function load(core: ModuleSource, command: ModuleSource): Promise<Beeline> {
  const loadCommands = async (): Promise<Commands> => {
    const { default: commandFactory } = await loaded(import("#wasm/beeline.js"));
    return Commands.load(commandFactory, command());
  };
  return new Beeline(await Core.load(factory, core()), loadCommands);
}
