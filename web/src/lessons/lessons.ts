/** The lessons: one for each section of the chapter (Dellaert, "Serial Link Manipulators"), then some beyond it. Each is
 * loaded when it is opened; its equations are MathML already. */
export interface Lesson {
  id: string;
  title: string;
  /** The section of the chapter, or null beyond it. */
  section: string | null;
  /** The numbered equations of the chapter that it is about. */
  equations: string[];
  /** What its exercises ask for, in their order, a few words each. */
  exercises: string[];
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

/** `covered`: section, equations and exercises; `scene`: what the address has behind "#arm=". */
function lesson(
  [id, title]: [string, string],
  covered: Partial<Pick<Lesson, "section" | "equations" | "exercises">>,
  [minutes, ...needs]: [number, ...string[]],
  scene: string,
  load: Lesson["load"],
): Lesson {
  const { section = null, equations = [], exercises = [] } = covered;
  return { id, title, section, equations, exercises, minutes, needs, scene: `#arm=${scene}`, load };
}

export const lessons: Lesson[] = [
  lesson(
    ["definitions", "1 Links and joints"],
    { section: "1.1", exercises: ["write a joint string"] },
    [6],
    "R:1&q=0.5",
    () => import("./text/1_definitions.md"),
  ),
  lesson(
    ["rrr", "2 A planar arm"],
    { section: "1.2", exercises: ["bring the tool to a pose"] },
    [5, "definitions"],
    `rrr&q=${at(0, 50, -80)}&frames=1`,
    () => import("./text/2_rrr.md"),
  ),
  lesson(
    ["forward", "3 Forward kinematics"],
    { section: "1.3", equations: ["1.1"], exercises: ["draw an arm RP", "find its formula"] },
    [12, "rrr"],
    `RR:3.5,2.5&q=${at(50, -65)}&frames=1`,
    () => import("./text/3_forward_kinematics.md"),
  ),
  lesson(
    ["describing", "4 Describing an arm"],
    { section: "1.4", exercises: ["write the joint string of an arm"] },
    [6, "forward"],
    `RR:3.5,2.5&q=${at(35, 40)}&frames=1`,
    () => import("./text/4_describing.md"),
  ),
  lesson(
    ["worked", "5 The three-link arm"],
    { section: "1.5", equations: ["1.2"], exercises: ["multiply the matrices of RP", "find an entry for RRR"] },
    [12, "describing"],
    `rrr&q=${at(112, -52, -60)}`,
    () => import("./text/5_worked_example.md"),
  ),
  lesson(
    ["joint-control", "6 Joint-space control"],
    { section: "1.6", equations: ["1.3"], exercises: ["find a gain"] },
    [10, "rrr"],
    `rrr&q=${rest}&goal=${goal}`,
    () => import("./text/6_joint_control.md"),
  ),
  lesson(
    ["jacobian", "7 The Jacobian"],
    {
      section: "1.7",
      equations: ["1.4"],
      exercises: ["name an arm with a constant Jacobian", "find a singular configuration and its lost direction"],
    },
    [12, "worked"],
    `rrr&q=${at(0, 90, 0)}&columns=1`,
    () => import("./text/7_jacobian.md"),
  ),
  lesson(
    ["cartesian", "8 Cartesian control"],
    { section: "1.8", equations: ["1.5", "1.6"], exercises: ["subtract two angles"] },
    [8, "joint-control", "jacobian"],
    `rrr&q=${bent}&goal=${goal}`,
    () => import("./text/8_cartesian_control.md"),
  ),
  lesson(
    ["waypoints", "9 Worked example of control"],
    { section: "1.9", equations: ["1.7"], exercises: ["find the Jacobian of RP"] },
    [12, "cartesian"],
    `rrr&q=${at(0, 90, 0)}&gain=0.02`,
    () => import("./text/9_waypoints.md"),
  ),
  lesson(
    ["comparison", "10 The two controllers compared"],
    { equations: ["1.3", "1.6"], exercises: ["count the steps"] },
    [5, "cartesian"],
    `rrr&q=${bent}&goal=${goal}`,
    () => import("./text/10_comparison.md"),
  ),
  lesson(
    ["inverse", "11 Inverse kinematics in steps"],
    { exercises: ["find the angle of joint 2"] },
    [8, "worked"],
    `rrr&q=${at(112, -52, -60)}`,
    () => import("./text/11_inverse.md"),
  ),
  lesson(
    ["exponentials", "12 Product of exponentials"],
    { exercises: ["find a screw"] },
    [10, "worked"],
    `rrr&q=${rest}`,
    () => import("./text/12_exponentials.md"),
  ),
  lesson(
    ["jacobians", "13 Space and body Jacobians"],
    { exercises: ["find a column of the body Jacobian"] },
    [8, "jacobian"],
    `rrr&q=${at(0, 90, 0)}&columns=1`,
    () => import("./text/13_jacobians.md"),
  ),
  lesson(
    ["failures", "14 Why it fails"],
    { exercises: ["turn a wrist at its singularity"] },
    [8, "jacobian"],
    `rrr&q=${rest}`,
    () => import("./text/14_failures.md"),
  ),
  lesson(
    ["redundant", "15 A redundant arm"],
    { exercises: ["count the joints"] },
    [6, "jacobian"],
    "RRRR:3,2.5,2,1.5&q=0.9,-0.8,-0.7,-0.6",
    () => import("./text/15_redundant.md"),
  ),
  lesson(
    ["proof", "16 A proof between samples"],
    { exercises: ["count the intervals"] },
    [8, "comparison"],
    `rrr&q=${at(112, -52, -60)}`,
    () => import("./text/16_proof.md"),
  ),
];

/** Pages beside the lessons: for teachers. */
export const appendices: Lesson[] = [
  lesson(["teachers", "For teachers"], {}, [0], `rrr&q=${at(112, -52, -60)}`, () => import("./text/teachers.md")),
  lesson(
    ["errata", "Errata of the chapter"],
    {},
    [0],
    `rrr&q=${at(112, -52, -60)}`,
    () => import("beeline-documents/errata.md"),
  ),
];

export const allPages: Lesson[] = [...lessons, ...appendices];

/** The section and the equations of the chapter that a lesson covers, in words. */
export function placeOf({ section, equations }: Lesson): string {
  const place = section === null ? "Beyond the chapter" : `Section ${section}`;
  return equations.length === 0 ? place : `${place}, eq. ${equations.join(" and ")}`;
}

/** The page of a name; of an unknown one the first lesson. */
export function lessonOf(id: string): Lesson {
  return allPages.find((one) => one.id === id) ?? (lessons[0] as Lesson);
}
