import { shown } from "../../elements/element.js";
import type { Fields } from "./fields.js";

/** Why a controller does not arrive; null for another reason. */
export function inControl(fields: Fields): string | null {
  const joint = `${fields.text("joint")} is at ${fields.value("value")}, `;
  switch (fields.of.code) {
    case "goal_outside_limits":
      return `at the goal ${joint}${fields.range()}`;
    case "start_outside_limits":
      return `at the start ${joint}${fields.range()}`;
    case "step_outside_limits":
      return `${fields.text("joint")} would leave its limits at step ${fields.number("step")}`;
    case "step_not_finite":
      return "the step of the controller is not finite";
    case "next_solution_far":
      return `the nearest solution is another elbow, ${fields.angle("change")} away`;
    case "not_converged":
    case "stagnates":
      return fields.is("oscillates")
        ? `it swings about the goal and does not arrive: ${left(fields)}`
        : `it does not arrive${fields.has("step") ? ` within ${fields.number("step")} steps` : ""}: ${left(fields)}`;
    case "diverges":
      return `it swings farther and farther from the goal: after ${fields.number("step")} steps ${left(fields)}`;
    default:
      return null;
  }
}

/** The largest of the errors. */
function left(fields: Fields): string {
  const { error } = fields.wording;
  const size =
    error === "angle"
      ? fields.angle("error")
      : error === "length"
        ? fields.length("error")
        : `${shown(fields.number("error"), 3)}, in m or rad,`;
  return `an error of ${size} is left`;
}
