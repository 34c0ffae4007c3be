import type { Core } from "../core/core.js";
import type { ArmWithShapes } from "../core/scene.js";
import type { ArmChooser } from "../panels/arm_chooser.js";
import { tooLarge } from "../core/limits.js";
import type { MeshList } from "../panels/mesh_list.js";
import { endsOf, TipChooser, type ChainEnd } from "../panels/tip_chooser.js";
import { baseName, fileAt, isMeshFile, visualMeshes, type PathFile } from "../scene/mesh_files.js";
import type { PageState } from "../state/page_state.js";
import type { Store } from "../state/store.js";
import { withCollisionMeshes } from "./scene_files.js";
import type { Shown } from "./section.js";

/** A URDF that was opened, with the meshes that came with it and after it. */
interface OpenedUrdf {
  json: string;
  text: string;
  /** The last link of the chain, if it was asked for; else empty. */
  tip: string;
  files: PathFile[];
}

const mostEnds = 50; // links that are tried as the end of a chain

/** Arms from files that were dropped or chosen, and the meshes of a URDF. */
export class ArmFiles {
  private urdf: OpenedUrdf | null = null;
  private shown: Shown | null = null;
  private reading = 0;
  private readonly tips = new TipChooser((tip) => this.again(tip));
  private again: (tip: string) => void = () => undefined;
  /** What is to be said of an arm once it is shown. */
  private remark = { json: "", text: "" };

  /** `reread` is called when the arm that is shown has other meshes. */
  constructor(
    private readonly core: Core,
    private readonly store: Store<PageState>,
    private readonly chooser: ArmChooser,
    private readonly list: MeshList,
    private readonly reread: () => void,
  ) {}

  /** The arm that is shown, as commands read it with the shapes of its links. */
  async withShapes(): Promise<ArmWithShapes> {
    const { arm } = this.store.get();
    if (this.urdf && this.urdf.json === this.shown?.arm.json) {
      const { text: urdf, files: opened, tip } = this.urdf;
      const { text, files } = await withCollisionMeshes(urdf, (path) => fileAt(path, opened));
      return { argument: "arm.urdf", tip, files: { ...files, "arm.urdf": text } };
    }
    if ("text" in arm) return { argument: arm.text, tip: "", files: {} };
    return { argument: "arm.json", tip: "", files: { "arm.json": arm.json } };
  }

  /** Takes an arm's file, with the meshes of a URDF; or more meshes of the URDF that is shown. Says why a file cannot be
   * read. */
  open(files: PathFile[]): void {
    this.openAll(files).catch((error: unknown) =>
      this.chooser.refuse(`A file cannot be read: ${(error as Error).message}`),
    );
  }

  private async openAll(files: PathFile[]): Promise<void> {
    const meshes = files.filter(({ path }) => isMeshFile(path));
    const usable = meshes.filter(({ file }) => tooLarge(file) === null);
    const arms = armFiles(files, meshes.length > 0);
    const [arm, ...others] = arms;
    const large = meshes.find(({ file }) => tooLarge(file) !== null);
    if (!arm) {
      await this.addMeshes(usable);
      if (large) this.chooser.refuse(tooLarge(large.file) ?? "");
      return;
    }
    const several = others.length > 0 ? `${baseName(arm.path)} is shown; not shown: ${names(others)}.` : "";
    const parts = [several, large ? (tooLarge(large.file) ?? "") : ""];
    await this.openArm(arm, usable, parts.filter((part) => part !== "").join(" "));
  }

  /** The page shows another arm: with its meshes, if it is the arm of the URDF. */
  take(shown: Shown): void {
    this.shown = shown;
    ++this.reading;
    this.list.clear();
    if (this.urdf?.json === shown.arm.json) void this.showMeshes();
    else this.tips.ask([]);
    if (this.remark.text !== "" && this.remark.json === shown.arm.json) this.chooser.say(this.remark.text);
    this.remark.text = "";
  }

  /** Shows the arm of a text: JSON, or a URDF with its meshes or a model of MuJoCo, whose chain ends at `tip`. Where the chain cannot end
   * without a choice, it is asked for. `remark` is said of the arm once it is shown. */
  openText(name: string, text: string, meshes: PathFile[] = [], remark = "", tip = ""): void {
    const isTree = isXml(name);
    if (tip === "") this.tips.ask([]);
    try {
      const json = this.jsonOf(name, text, tip);
      this.urdf = isTree ? { json, text, tip, files: meshes } : null;
      this.remark = { json, text: remark };
      this.store.set({ arm: { json: isTree ? json : sameShapes(json, text) }, q: null, goal: null, waypoints: [] });
    } catch (error) {
      const ends = isTree && tip === "" ? this.endsThatDo(name, text) : [];
      if (ends.length === 0) return this.chooser.refuse((error as Error).message);
      this.tips.ask(ends);
      this.chooser.ask(this.tips.root);
      this.tips.focus();
      this.again = (chosen) => this.openText(name, text, meshes, remark, chosen);
    }
  }

  /** The JSON of the arm of a text. Throws where the core refuses it. */
  private jsonOf(name: string, text: string, tip: string): string {
    const arm = this.core.arm(name, { [name]: text }, { tip });
    const { json } = arm;
    arm.release();
    return json;
  }

  /** The links of a URDF at which the core can end the chain: none where another tip does not mend the file. */
  private endsThatDo(name: string, text: string): ChainEnd[] {
    return endsOf(text)
      .slice(0, mostEnds)
      .filter(({ link }) => {
        try {
          return this.jsonOf(name, text, link) !== "";
        } catch {
          return false;
        }
      });
  }

  private async openArm({ path, file }: PathFile, meshes: PathFile[], remark: string): Promise<void> {
    const refusal = tooLarge(file);
    if (refusal !== null) return this.chooser.refuse(refusal);
    const reading = ++this.reading; // of two files the later is shown
    const text = await file.text();
    if (reading === this.reading) this.openText(baseName(path), text, meshes, remark);
  }

  private async addMeshes(meshes: PathFile[]): Promise<void> {
    if (!this.urdf || this.urdf.json !== this.shown?.arm.json)
      return this.chooser.refuse("Meshes belong to a URDF file: drop it with them, or before them.");
    this.urdf.files.push(...meshes);
    this.reread();
    await this.showMeshes();
  }

  private async showMeshes(): Promise<void> {
    const { urdf, shown } = this;
    const reading = ++this.reading; // of several answers the last one's is shown
    if (!urdf || !shown) return;
    const wanted = visualMeshes(urdf.text);
    if (wanted.length === 0) return;
    if (urdf.files.length === 0)
      return this.list.say(
        `Drawn without meshes. ${missing(wanted.map(baseName))} Drop them too, all at once or a folder.`,
      );
    try {
      const { joints } = JSON.parse(shown.arm.json) as { joints: { link?: string }[] };
      const links = ["", ...joints.map(({ link = "" }) => link)];
      const report = await shown.picture.showMeshes(urdf.text, links, urdf.files, () => this.list.moved());
      if (reading !== this.reading) return;
      if (!report) return this.list.say("Drawn without meshes: this arm moves in a plane.");
      const count = report.meshes.length;
      this.list.say(
        [`${count} ${count === 1 ? "mesh" : "meshes"}.`, missing(report.missing), ...report.faults].join(" ").trim(),
      );
      this.list.show(report.meshes);
    } catch (error) {
      if (reading === this.reading) this.list.say(`The meshes cannot be shown: ${(error as Error).message}`);
    }
  }
}

/** The files that are arms: URDF before JSON; beside meshes no others, else the first whatever it is. */
function armFiles(files: PathFile[], besideMeshes: boolean): PathFile[] {
  for (const ending of [/\.urdf$/i, /\.json$/i]) {
    const found = files.filter(({ path }) => ending.test(path));
    if (found.length > 0) return found;
  }
  return besideMeshes ? [] : files.slice(0, 1);
}

/** Whether a file describes a tree of links in XML: a URDF, or a model of MuJoCo. */
function isXml(name: string): boolean {
  return /\.(urdf|xml|mjcf|xacro)$/i.test(name);
}

function names(files: PathFile[]): string {
  return files.map(({ path }) => baseName(path)).join(", ");
}

/** The JSON of an arm with the list of shapes that its file has: the core leaves it out. */
function sameShapes(json: string, file: string): string {
  const { shapes } = JSON.parse(file) as { shapes?: unknown };
  return shapes === undefined ? json : JSON.stringify({ ...(JSON.parse(json) as object), shapes });
}

/** Which meshes are missing, a few by name. */
function missing(files: string[]): string {
  if (files.length === 0) return "";
  const few = 5;
  const more = files.length > few ? ` and ${files.length - few} more` : "";
  return `Missing: ${files.slice(0, few).join(", ")}${more}.`;
}
