import type { Core } from "../core/core.js";
import type { Session } from "../live/live.js";
import { sections, type ArmSource, type PageState } from "../state/page_state.js";

/** The part of the state that `beeline view` sets. Without a section the page begins where its motion or obstacles are. */
export function stateOfSession(core: Core, session: Session): Partial<PageState> {
  const scene = session.scene ?? "";
  const begins = session.trajectory !== null ? "line" : scene === "" ? null : "obstacles";
  const wanted = session.section ?? begins;
  const section = sections.find((name) => name === wanted);
  return {
    arm: sourceOf(core, session.arm),
    scene,
    clearance: session.clearance ?? 0,
    ...(section && { section }),
  };
}

/** The arm by its name where it is a built-in one, so that the address stays short. An arm with shapes is its JSON: the
 * shapes may be others than the built-in ones. */
function sourceOf(core: Core, json: string): ArmSource {
  const { name, shapes } = JSON.parse(json) as { name?: string; shapes?: unknown };
  if (shapes !== undefined || name === undefined || !core.builtInNames().includes(name)) return { json };
  const file = "arm.json";
  const arms = [core.arm(name), core.arm(file, { [file]: json })];
  for (const arm of arms) arm.release();
  return arms[0]?.json === arms[1]?.json ? { text: name } : { json };
}
