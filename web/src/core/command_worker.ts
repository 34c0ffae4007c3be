/// <reference lib="webworker" />
import factory from "beeline-module/beeline.js";
import type { Factory } from "./load.js";
import type { CommandModule } from "./module.js";
import { serve, type Scope } from "./worker.js";

serve(self as unknown as Scope, factory as unknown as Factory<CommandModule>);
