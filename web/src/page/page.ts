import factory from "beeline-module/core.js";
import { addressOf, longestAddress, partOf, stateOf } from "../address/address.js";
import { CoreWorker } from "../core/client.js";
import type { Arm } from "../core/arm.js";
import { Core } from "../core/core.js";
import { compile, type Factory } from "../core/load.js";
import type { CoreModule } from "../core/module.js";
import { ArmChooser } from "../panels/arm_chooser.js";
import { element } from "../panels/element.js";
import { MeshList } from "../panels/mesh_list.js";
import { lessons } from "../lessons/lessons.js";
import { JointsPanel } from "../panels/joints.js";
import { follow, sessionOf } from "../live/live.js";
import { initialState, type ArmSource, type PageState, type Section } from "../state/page_state.js";
import { bytesOf, startWorker } from "../share/parts.js";
import { savedAddress, savedTrajectory } from "../share/save_page.js";
import { Store } from "../state/store.js";
import { ArmFiles } from "./arm_files.js";
import { ArmView } from "./arm_view.js";
import { Control } from "./control.js";
import { describe, type ArmDescription } from "../core/description.js";
import { Hold } from "./hold.js";
import { LessonsSection } from "./lessons.js";
import { MotionSection } from "./motion.js";
import { ReachSection } from "./reach.js";
import { svgButton } from "./save_svg.js";
import type { SectionPanel, Services, Shown } from "./section.js";
import { toolbar } from "./toolbar.js";

/** The arm's file in the folder of a command. */
const armFile = "arm.json";

/** The state of an address; a lesson begins with its figure where the address has no arm. */
async function stateAt(hash: string): Promise<PageState> {
  const state = await stateOf(hash);
  const scene = lessons.find(({ id }) => id === state.lesson)?.scene;
  if (scene === undefined || state.section !== "lessons") return state;
  return { ...state, ...(await partOf(scene)), ...(await partOf(hash)) };
}

/** The page: its state, the arm that it shows, and a panel for each section. */
export class Page {
  private readonly panels: Map<Section, { title: string; panel: SectionPanel }>;
  private readonly links: Map<Section, HTMLElement>;
  private readonly services: Services;
  private readonly motion: MotionSection;
  private readonly files: ArmFiles;
  private readonly saveSvg: HTMLButtonElement;
  private shown: Shown | null = null;
  /** The part of the state that belongs to the arm that is shown. */
  private valid: Pick<PageState, "arm" | "q" | "goal"> | null = null;
  private writing = 0;
  private reading = 0;
  private readonly tooLong = element("p", { role: "status", class: "refusal" });

  private constructor(
    private readonly document: Document,
    private readonly core: Core,
    worker: CoreWorker,
    private readonly store: Store<PageState>,
    private readonly chooser: ArmChooser,
    meshes: MeshList,
  ) {
    this.files = new ArmFiles(core, store, chooser, meshes);
    this.services = {
      store,
      command: (args, files = {}, progress = undefined) =>
        worker.command(args, { ...files, [armFile]: this.shown?.arm.json ?? "" }, progress),
      reach: (task, progress) => worker.reach(task, progress),
      cancel: () => worker.cancel(),
    };
    this.saveSvg = svgButton(this.services, (reason) => chooser.refuse(reason));
    const joints = new JointsPanel((q) => store.set({ q }));
    this.motion = new MotionSection(this.services);
    this.panels = new Map<Section, { title: string; panel: SectionPanel }>([
      ["hold", { title: "Hold", panel: new Hold(this.services, joints) }],
      ["control", { title: "Control", panel: new Control(this.services) }],
      ["motion", { title: "Motion", panel: this.motion }],
      ["reach", { title: "Reach", panel: new ReachSection(this.services) }],
      ["lessons", { title: "Lessons", panel: new LessonsSection(this.services, joints, (text) => core.arm(text)) }],
    ]);
    const side = document.getElementById("side") as HTMLElement;
    side.replaceChildren(chooser.root, this.tooLong, ...[...this.panels.values()].map(({ panel }) => panel.root));
    (document.getElementById("tools") as HTMLElement).replaceChildren(
      ...toolbar(
        store,
        () => this.shown?.view ?? null,
        this.saveSvg,
        (reason) => chooser.refuse(reason),
      ),
      this.motion.light,
    );
    this.links = new Map([...this.panels].map(([name, { title }]) => [name, this.link(name, title)]));
    (document.getElementById("sections") as HTMLElement).replaceChildren(...this.links.values());
    this.showSections();
    store.subscribe((_, changed) => this.changed(changed));
    document.defaultView?.addEventListener("hashchange", ({ newURL }) => void this.readAddress(new URL(newURL).hash));
  }

  /** Loads the core, reads the address and shows it. */
  static async open(document: Document): Promise<Page> {
    const core = await Core.load(
      factory as unknown as Factory<CoreModule>,
      (await bytesOf("core-module")) as BufferSource,
    );
    const worker = new CoreWorker(startWorker, async () => compile((await bytesOf("command-module")) as BufferSource));
    const state = await stateAt(location.hash === "" ? savedAddress() : location.hash);
    const session = await sessionOf(document);
    if (session && location.hash === "") state.arm = { json: session.arm };
    const store = new Store(state);
    let page: Page | null = null;
    const meshes = new MeshList();
    const chooser = new ArmChooser(
      core.builtInNames(),
      (text) => store.set({ arm: { text }, q: null, goal: null }),
      (files) => page?.files.open(files),
      (json) => page?.files.openText("dh_table.json", json),
      meshes.line,
      meshes.root,
    );
    page = new Page(document, core, worker, store, chooser, meshes);
    chooser.acceptDrops(document.body);
    page.takeArm(store.get().arm);
    if (session) page.goLive();
    const trajectory = session ? session.trajectory : await savedTrajectory();
    if (trajectory !== null) page.openTrajectory(trajectory);
    return page;
  }

  /** Follows the joint values that a program posts to `beeline view`. */
  private goLive(): void {
    const light = element("span", { role: "status", class: "live" }, "connecting");
    (this.document.getElementById("tools") as HTMLElement).append(light);
    follow(
      (q) => {
        if (q.length === this.shown?.arm.dof) this.store.set({ q });
      },
      (text) => (light.textContent = text),
    );
  }

  /** Plays the trajectory that the page was opened with. */
  private openTrajectory(csv: string): void {
    this.store.set({ section: "motion" });
    this.motion.open("motion.csv", csv);
  }

  private changed(changed: ReadonlySet<keyof PageState>): void {
    if (changed.has("section")) this.showSections();
    const { arm } = this.store.get();
    // A panel that was hidden has missed the changes since.
    const missed = changed.has("section") ? (Object.keys(initialState) as (keyof PageState)[]) : [];
    if (arm === this.valid?.arm) this.update(new Set([...changed, ...missed]));
    else if (changed.has("arm")) this.takeArm(arm);
    void this.writeAddress();
  }

  /** Reads an arm and shows it; the one before stays where it is refused. */
  private takeArm(source: ArmSource): void {
    try {
      const text = "text" in source ? source.text : armFile;
      const files = "text" in source ? {} : { [armFile]: source.json };
      this.show(this.core.arm(text, files), source);
    } catch (error) {
      if (this.valid) this.store.set(this.valid);
      else if (source !== initialState.arm) this.store.set({ arm: initialState.arm, q: null, goal: null });
      this.chooser.refuse((error as Error).message);
    }
  }

  private show(arm: Arm, source: ArmSource): void {
    this.services.cancel(); // what is computed for the arm before
    this.shown?.view.dispose();
    this.shown?.arm.release();
    const description = describe(arm);
    const holder = this.document.getElementById("stage") as HTMLElement;
    this.shown = {
      arm,
      description,
      view: new ArmView(holder, arm, sizeOf(arm, description), description.reach?.centre?.[2] ?? 0),
    };
    for (const { panel } of this.panels.values()) panel.take(this.shown);
    this.chooser.show(description.name);
    this.files.take(this.shown);
    this.saveSvg.hidden = !arm.planar;
    const { q, goal } = this.store.get();
    this.valid = { arm: source, q, goal };
    if (q === null || q.length !== arm.dof) this.store.set({ q: arm.displayConfiguration() });
    else this.update(new Set(["q"]));
  }

  private update(changed: ReadonlySet<keyof PageState>): void {
    const { arm, q, goal, section } = this.store.get();
    if (!q || q.length !== this.shown?.arm.dof) return;
    this.valid = { arm, q, goal };
    this.panels.get(section)?.panel.update(q, changed);
  }

  private showSections(): void {
    const { section } = this.store.get();
    for (const [name, { panel }] of this.panels) {
      if (name !== section && !panel.root.hidden) panel.leave();
      panel.root.hidden = name !== section;
      const link = this.links.get(name); // kept, as it may have the focus
      if (name === section) link?.setAttribute("aria-current", "page");
      else link?.removeAttribute("aria-current");
    }
  }

  private link(name: Section, title: string): HTMLElement {
    const link = element("a", { href: `#section=${name}` }, title);
    link.addEventListener("click", (event) => {
      event.preventDefault();
      this.store.set({ section: name });
    });
    return link;
  }

  private async readAddress(hash: string): Promise<void> {
    const turn = ++this.reading;
    ++this.writing; // what is about to be written is older
    const state = await stateAt(hash);
    if (turn === this.reading) this.store.set(state);
  }

  private async writeAddress(): Promise<void> {
    const turn = ++this.writing;
    await new Promise((resolve) => setTimeout(resolve, 250)); // browsers limit how often it may change
    if (turn !== this.writing) return;
    const hash = `#${await addressOf(this.store.get())}`;
    if (turn !== this.writing) return;
    const written = hash.length <= longestAddress;
    this.tooLong.textContent = written
      ? ""
      : "This is too long for a link: the address stays as it was. Use Save page.";
    if (!written) return;
    // In full, as the frame of a notebook (about:srcdoc) takes other addresses for addresses of the notebook.
    history.replaceState(
      null,
      "",
      location.href.replace(/#.*|$/, () => hash),
    );
  }
}

/** How much of the world the picture shows, metres: the reach, or where it has no bound the arm as it is shown first. */
function sizeOf(arm: Arm, { reach }: ArmDescription): number {
  const far = arm.forward(arm.displayConfiguration()).map((pose) => Math.hypot(...pose.subarray(12, 15)));
  return reach?.radius || 1.3 * Math.max(...far) || 1;
}
