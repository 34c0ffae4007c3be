/** The lessons: one for each section of the chapter (Dellaert, "Serial Link Manipulators"), then some beyond it. Each is
 * loaded when it is opened; its equations are MathML already. */
export interface Lesson {
  id: string;
  title: string;
  /** The section of the chapter, or null beyond it. */
  section: string | null;
  /** What reading and exercises take, minutes. */
  minutes: number;
  /** The lessons that it builds on. */
  needs: string[];
  /** The address of its figure. */
  scene: string;
  load(): Promise<{ default: string }>;
}

const degree = Math.PI / 180;
const at = (...degrees: number[]): string => degrees.map((value) => value * degree).join(",");
const rest = at(0, 0, 0);
const goal = at(99.2, -68.8, -30.4);
const bent = "-0.5,0.9,-0.4";

/** `scene`: what the address has behind "#arm=". */
function lesson(
  [id, title]: [string, string],
  section: string | null,
  [minutes, ...needs]: [number, ...string[]],
  scene: string,
  load: Lesson["load"],
): Lesson {
  return { id, title, section, minutes, needs, scene: `#arm=${scene}`, load };
}

export const lessons: Lesson[] = [
  lesson(["definitions", "1 Links and joints"], "1.1", [6], "R:1&q=0.5", () => import("./text/1_definitions.md")),
  lesson(
    ["rrr", "2 A planar arm"],
    "1.2",
    [5, "definitions"],
    `rrr&q=${at(0, 50, -80)}&frames=1`,
    () => import("./text/2_rrr.md"),
  ),
  lesson(
    ["forward", "3 Forward kinematics"],
    "1.3",
    [12, "rrr"],
    `RR:3.5,2.5&q=${at(50, -65)}&frames=1`,
    () => import("./text/3_forward_kinematics.md"),
  ),
  lesson(
    ["describing", "4 Describing an arm"],
    "1.4",
    [6, "forward"],
    `RR:3.5,2.5&q=${at(35, 40)}&frames=1`,
    () => import("./text/4_describing.md"),
  ),
  lesson(
    ["worked", "5 The three-link arm"],
    "1.5",
    [12, "describing"],
    `rrr&q=${at(112, -52, -60)}`,
    () => import("./text/5_worked_example.md"),
  ),
  lesson(
    ["joint-control", "6 Joint-space control"],
    "1.6",
    [10, "rrr"],
    `rrr&q=${rest}&goal=${goal}`,
    () => import("./text/6_joint_control.md"),
  ),
  lesson(
    ["jacobian", "7 The Jacobian"],
    "1.7",
    [12, "worked"],
    `rrr&q=${at(0, 90, 0)}&columns=1`,
    () => import("./text/7_jacobian.md"),
  ),
  lesson(
    ["cartesian", "8 Cartesian control"],
    "1.8",
    [8, "joint-control", "jacobian"],
    `rrr&q=${bent}&goal=${goal}`,
    () => import("./text/8_cartesian_control.md"),
  ),
  lesson(
    ["waypoints", "9 Worked example of control"],
    "1.9",
    [12, "cartesian"],
    `rrr&q=${at(0, 90, 0)}&gain=0.02`,
    () => import("./text/9_waypoints.md"),
  ),
  lesson(
    ["comparison", "10 Both side by side"],
    null,
    [5, "cartesian"],
    `rrr&q=${bent}&goal=${goal}`,
    () => import("./text/10_comparison.md"),
  ),
  lesson(
    ["inverse", "11 Inverse kinematics in steps"],
    null,
    [8, "worked"],
    `rrr&q=${at(112, -52, -60)}`,
    () => import("./text/11_inverse.md"),
  ),
  lesson(
    ["exponentials", "12 Product of exponentials"],
    null,
    [10, "worked"],
    `rrr&q=${rest}`,
    () => import("./text/12_exponentials.md"),
  ),
  lesson(
    ["jacobians", "13 Space and body Jacobians"],
    null,
    [8, "jacobian"],
    `rrr&q=${at(0, 90, 0)}&columns=1`,
    () => import("./text/13_jacobians.md"),
  ),
  lesson(
    ["failures", "14 Why it fails"],
    null,
    [8, "jacobian"],
    `rrr&q=${rest}`,
    () => import("./text/14_failures.md"),
  ),
  lesson(
    ["redundant", "15 A redundant arm"],
    null,
    [6, "jacobian"],
    "RRRR:3,2.5,2,1.5&q=0.9,-0.8,-0.7,-0.6",
    () => import("./text/15_redundant.md"),
  ),
  lesson(
    ["proof", "16 A proof between samples"],
    null,
    [8, "comparison"],
    `rrr&q=${at(112, -52, -60)}`,
    () => import("./text/16_proof.md"),
  ),
];

/** Pages beside the lessons: for teachers. */
export const appendices: Lesson[] = [
  lesson(["teachers", "For teachers"], null, [0], `rrr&q=${at(112, -52, -60)}`, () => import("./text/teachers.md")),
  lesson(
    ["errata", "Errata of the chapter"],
    null,
    [0],
    `rrr&q=${at(112, -52, -60)}`,
    () => import("beeline-documents/errata.md"),
  ),
];

export const allPages: Lesson[] = [...lessons, ...appendices];

/** The page of a name; of an unknown one the first lesson. */
export function lessonOf(id: string): Lesson {
  return allPages.find((one) => one.id === id) ?? (lessons[0] as Lesson);
}
