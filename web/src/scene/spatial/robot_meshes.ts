import { Color, Group, LoadingManager, Mesh, Texture, type Material, type Object3D } from "three";
import URDFLoader, { type URDFRobot } from "urdf-loader";
import { jointColour, resolved } from "../colours.js";
import { baseName, fileAt, visualMeshes, type PathFile } from "../mesh_files.js";
import { putAt } from "./marks.js";
import { MeshLook } from "./mesh_look.js";
import { readMesh } from "./mesh_reader.js";

const blank = "data:image/gif;base64,R0lGODlhAQABAIAAAP///wAAACwAAAAAAQABAAACAkQBADs="; // one white pixel

/** A mesh in the picture. */
export interface PlacedMesh {
  file: string;
  link: string;
  /** Its frame, at the visual's origin. */
  frame: Object3D;
}

/** The visual meshes of a URDF, in the frames of an arm's links. */
export class RobotMeshes extends Group {
  readonly meshes: PlacedMesh[] = [];
  readonly missing: string[] = [];
  /** What is wrong with files, a sentence each. */
  readonly faults: string[] = [];
  private readonly frames: Group[];
  private readonly addresses = new Map<File, string>();

  private readonly look: MeshLook;
  /** All but the outlines. */
  private readonly surfaces: Mesh[] = [];
  private lit: number | null = null;

  private constructor(links: number, rim: number) {
    super();
    this.look = new MeshLook(rim);
    this.frames = Array.from({ length: links }, () => new Group());
    for (const frame of this.frames) frame.matrixAutoUpdate = false;
    this.add(...this.frames);
  }

  /** `links`: the names of the arm's links, the root's first, as the poses of place() are ordered; `rim`: the width of
   * outlines, m; `loaded` is called when its pictures are there. Reads nothing but these files. */
  static async read(
    urdf: string,
    links: string[],
    files: PathFile[],
    rim: number,
    loaded: () => void,
  ): Promise<RobotMeshes> {
    const made = new RobotMeshes(links.length, rim);
    const bytes = new Map<string, ArrayBuffer>();
    for (const name of visualMeshes(urdf)) {
      const found = fileAt(name, files);
      if (found) bytes.set(name, await found.file.arrayBuffer());
      else made.missing.push(baseName(name));
    }
    try {
      made.build(made.robot(urdf, bytes, files, loaded), links);
    } catch (error) {
      made.dispose();
      throw error;
    }
    return made;
  }

  /** The links that have a mesh, 0 the root. */
  get covered(): Set<number> {
    return new Set(this.frames.flatMap((frame, i) => (frame.children.length > 0 ? [i] : [])));
  }

  /** Shows the meshes on links at these poses: column-major 4 x 4 matrices. */
  place(poses: ArrayLike<number>[]): void {
    this.frames.forEach((frame, i) => putAt(frame, poses[i] as ArrayLike<number>));
  }

  /** Takes the colours of the page, light or dark. */
  paint(): void {
    this.look.paint();
  }

  /** Shows the link that a joint moves in the joint's colour; null: none. Returns whether it looks different now. */
  light(joint: number | null): boolean {
    if (joint === this.lit) return false;
    this.lit = joint;
    const colour = joint === null ? null : new Color(resolved(jointColour(joint)));
    for (const mesh of this.surfaces) this.look.light(mesh, this.jointOf(mesh) === joint ? colour : null);
    return this.surfaces.length > 0;
  }

  /** The joint that moves a part of a mesh; null for the root's and for other parts. */
  jointOf(part: Object3D): number | null {
    const link = this.linkOf(part);
    return link === null || link === 0 ? null : link - 1;
  }

  /** The link that a part of a mesh belongs to, 0 the root; null for other parts. */
  private linkOf(part: Object3D): number | null {
    for (let now: Object3D | null = part; now !== null; now = now.parent) {
      const link = this.frames.indexOf(now as Group);
      if (link >= 0) return link;
    }
    return null;
  }

  override dispose(): this {
    this.traverse((part) => {
      const { geometry, material: materials } = part as Partial<Mesh>; // of lines and points too
      geometry?.dispose();
      for (const material of [materials ?? []].flat() as Material[]) {
        for (const value of Object.values(material)) if (value instanceof Texture) value.dispose();
        material.dispose();
      }
    });
    this.look.dispose();
    for (const address of this.addresses.values()) URL.revokeObjectURL(address);
    return this.removeFromParent();
  }

  /** Hangs each visual into the frame of the arm's link that it moves with. */
  private build(robot: URDFRobot, links: string[]): void {
    robot.updateMatrixWorld(true);
    const frames = new Map<Object3D, number>([[robot, 0]]);
    links.forEach((name, i) => {
      const link = robot.links[name];
      if (link && i > 0) frames.set(link, i);
    });
    for (const [link, i] of frames) this.frames[i]?.matrix.copy(link.matrixWorld);
    this.updateMatrixWorld(true);
    const visuals: Object3D[] = [];
    robot.traverse((part) => {
      if ("isURDFVisual" in part && part.children.length > 0) visuals.push(part);
    });
    for (const visual of visuals) {
      const link = visual.parent as Object3D;
      let moved = link;
      while (!frames.has(moved)) moved = moved.parent as Object3D;
      this.frames[frames.get(moved) ?? 0]?.attach(visual);
      const file = visual.userData["file"] as string | undefined;
      if (file !== undefined) this.meshes.push({ file, link: link.name, frame: visual });
    }
    this.traverse((part) => {
      if (part instanceof Mesh) this.surfaces.push(part);
    });
    for (const mesh of this.surfaces) this.look.dress(mesh);
    this.paint();
  }

  /** The robot with all joints at 0. */
  private robot(urdf: string, bytes: Map<string, ArrayBuffer>, files: PathFile[], loaded: () => void): URDFRobot {
    const document = new DOMParser().parseFromString(urdf, "text/xml");
    // The core moves the arm: what else a joint holds is not needed, and some of it stops the loader.
    for (const part of document.querySelectorAll("mimic, axis, limit, inertial")) part.remove();
    const meshes = document.querySelectorAll("link > visual > geometry > mesh[filename]");
    const names = [...meshes].map((mesh) => mesh.getAttribute("filename") ?? "");
    meshes.forEach((mesh, i) => mesh.setAttribute("filename", String(i)));
    const manager = new LoadingManager(loaded);
    manager.setURLModifier((address) => (/^(data|blob):/.test(address) ? address : this.addressOf(address, files)));
    const loader = new URDFLoader(manager);
    loader.packages = (name) => name; // textures may be in one
    loader.loadMeshCb = (index, _, material, done) => {
      const name = names[Number(index)] ?? "";
      const content = bytes.get(name);
      if (!content) return;
      const file = baseName(name);
      try {
        const mesh = readMesh(file, content, material, manager);
        done(mesh);
        if (mesh.parent) mesh.parent.userData["file"] = file;
      } catch (error) {
        const fault = `${file} is not shown: ${(error as Error).message}.`;
        if (!this.faults.includes(fault)) this.faults.push(fault);
      }
    };
    return loader.parse(document);
  }

  /** Where the browser finds a dropped picture; a white one for others, so that nothing is asked of a server. */
  private addressOf(path: string, files: PathFile[]): string {
    const file = fileAt(path, files)?.file;
    if (!file) return blank;
    const address = this.addresses.get(file) ?? URL.createObjectURL(file);
    this.addresses.set(file, address);
    return address;
  }
}
