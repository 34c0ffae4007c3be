/** What a first user computes, as plain data: of each built-in arm a pose and a Jacobian, of some the joint values of that
 * pose. */
export async function compute(load) {
  const beeline = await load();
  const arms = beeline.builtInNames().map((name) => {
    const arm = beeline.readArm(name);
    const q = arm.description.joints
      .filter(({ mimic }) => mimic === undefined)
      .map(({ limits: { lower, upper } }, i) => {
        const fraction = 0.3 + 0.07 * i;
        return (1 - fraction) * (lower ?? -1) + fraction * (upper ?? 1);
      });
    const pose = beeline.forwardKinematics(arm, q);
    const inverse = arm.dof <= 6 ? beeline.inverseKinematics(arm, pose, { seed: q }).map((found) => [...found]) : null;
    const found = { name, q, pose: [...pose], jacobian: beeline.jacobian(arm, q), inverse };
    arm.release();
    return found;
  });
  const rrr = beeline.readArm("rrr");
  const { trajectory, ...line } = await beeline.line(rrr, [1.95, -0.9, -1.05], [[4.5, 5.2, 0]]);
  return { arms, line, positions: trajectory.rows() };
}
