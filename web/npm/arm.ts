import type { Arm as CoreArm } from "../src/core/arm.js";
import type { ArmDescription } from "../src/core/description.js";
import { toolPosition } from "../src/core/pose.js";
import type { ChainEnds, InputFiles } from "../src/core/types.js";

/** An arm. It lies in the memory of the WebAssembly module, which does not free it by itself: call release() when it is
 * not needed any more. */
export class Arm {
  readonly name: string;
  /** The number of joint values. */
  readonly dof: number;
  readonly planar: boolean;
  /** Name, type and limits of each joint, reach: what `beeline show --json` prints. */
  readonly description: ArmDescription;
  /** The height of the plane of the tool, m; null for an arm that is not planar. @internal */
  readonly planeHeight: number | null;

  /** @internal */
  constructor(
    /** @internal */ readonly core: CoreArm,
    /** The argument ARM of the command, the files that it names, and --base and --tip. @internal */
    readonly source: { arm: string; files: InputFiles; ends: ChainEnds },
  ) {
    this.description = core.description as ArmDescription;
    this.name = this.description.name;
    this.dof = core.dof;
    this.planar = core.planar;
    this.planeHeight = core.planar ? (toolPosition(core, new Float64Array(core.dof))[2] ?? 0) : null;
  }

  /** The arm as JSON, as `beeline show --out` writes it: armFromJson() reads it. */
  toJson(): string {
    return this.core.json;
  }

  /** Frees its memory. Afterwards it refuses to compute. */
  release(): void {
    this.core.release();
  }
}
