export type { IkAnswer, LineAnswer, Reasoned } from "./answers.js";
export type { Arm } from "./arm.js";
export type { Beeline, DhRow, InverseOptions } from "./beeline.js";
export type { Numbers, Options } from "./values.js";
export { poseNumbers, type PoseNumbers } from "../src/core/pose.js";
export type { ArmDescription, JointDescription } from "../src/core/description.js";
export type { Quantity, Trajectory } from "../src/core/trajectory.js";
export { CoreError, type ErrorCode } from "../src/core/types.js";
export type { ChainEnds, CommandResult, Files, Frame, Manipulability, Matrix } from "../src/core/types.js";
