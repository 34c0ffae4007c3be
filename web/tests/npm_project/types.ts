import { CoreError, load, poseNumbers, type Arm, type IkAnswer, type Matrix } from "beeline-arms";

const beeline = await load();
const arm: Arm = beeline.readArm("ur5");
const pose: Matrix = beeline.forwardKinematics(arm, [0, -1, 1, 0, 1, 0]);
const solutions: Float64Array[] = beeline.inverseKinematics(arm, pose, { seed: [0, -1, 1, 0, 1, 0], all: true });
const rows: number[][] = beeline.jacobian(arm, solutions[0] ?? [], { frame: "tool" });
const answer: IkAnswer = await beeline.ik(arm, pose, { maxSamples: 100, all: true });
const { trajectory } = await beeline.line(arm, answer.solutions[0] ?? [], [pose], { speed: 0.5 });
const times: Float64Array | undefined = trajectory?.times;
export const all = [rows, times, poseNumbers(pose).quaternion];
interface OwnOptions {
  all?: boolean;
}
const own: OwnOptions = { all: true };
export const found: IkAnswer[] = [
  await beeline.ik(arm, pose, own),
  await beeline.verb<IkAnswer>("ik", arm, { pose, all: true }),
];
beeline.readArm("a.urdf", { "a.urdf": new Uint8Array() });
// @ts-expect-error an option is no object
await beeline.ik(arm, pose, { all: { yes: true } });
// @ts-expect-error there is no such frame
beeline.jacobian(arm, [], { frame: "world" });
// @ts-expect-error there is no default convention
beeline.armFromDh("table", []);
// @ts-expect-error load() makes it
new CoreError(2);
