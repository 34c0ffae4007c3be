/** The lessons, in the order of the sections of the chapter (Dellaert, "Serial Link Manipulators"). Each is loaded when
 * it is opened; its equations are MathML already. */
export interface Lesson {
  id: string;
  title: string;
  /** The address of its figure. */
  scene: string;
  load(): Promise<{ default: string }>;
}

export const lessons: Lesson[] = [
  {
    id: "definitions",
    title: "1 Links and joints",
    scene: "#arm=rrr&q=0.5,0.6,-0.8",
    load: () => import("./text/1_definitions.md"),
  },
  { id: "rrr", title: "2 A planar arm", scene: "#arm=rrr&q=0,0,0", load: () => import("./text/2_rrr.md") },
  {
    id: "forward",
    title: "3 Forward kinematics",
    scene: "#arm=rrr&q=0.5,0.6,-0.8&frames=1",
    load: () => import("./text/3_forward_kinematics.md"),
  },
  {
    id: "describing",
    title: "4 Describing an arm",
    scene: "#arm=RRR:3.5,3.5,2&q=0.5,0.6,-0.8&frames=1",
    load: () => import("./text/4_describing.md"),
  },
  {
    id: "worked",
    title: "5 The three-link arm",
    scene: "#arm=rrr&q=0,1.5707963267948966,0",
    load: () => import("./text/5_worked_example.md"),
  },
  {
    id: "joint-control",
    title: "6 Joint-space control",
    scene: "#arm=rrr&q=-0.5,0.9,-0.4&goal=1.73,-1.2,-0.53",
    load: () => import("./text/6_joint_control.md"),
  },
  {
    id: "jacobian",
    title: "7 The Jacobian",
    scene: "#arm=rrr&q=0,1.5707963267948966,0&columns=1",
    load: () => import("./text/7_jacobian.md"),
  },
  {
    id: "cartesian",
    title: "8 Cartesian control",
    scene: "#arm=rrr&q=-0.5,0.9,-0.4&goal=1.73,-1.2,-0.53",
    load: () => import("./text/8_cartesian_control.md"),
  },
  {
    id: "comparison",
    title: "9 Both side by side",
    scene: "#arm=rrr&q=-0.5,0.9,-0.4&goal=1.73,-1.2,-0.53",
    load: () => import("./text/9_comparison.md"),
  },
];
