import {
  BackSide,
  Color,
  Mesh,
  MeshBasicMaterial,
  MeshLambertMaterial,
  type BufferGeometry,
  type Material,
  type MeshPhongMaterial,
} from "three";
import { mergeVertices } from "three/addons/utils/BufferGeometryUtils.js";
import { resolved } from "../colours.js";
import { lightness } from "./arm_figure.js";
import { castShadow } from "./floor_shadow.js";

const mostMerged = 150_000; // corners: a larger mesh is outlined as it is

/** The look of the drawn arms for meshes of files: matt, darker than a white ground, outlined, with a shadow. */
export class MeshLook {
  private readonly matt = new Map<Material, { material: MeshLambertMaterial; colour: Color }>();
  /** Of the link that the mouse points at: for each material a mix with the colour of the joint. */
  private readonly glow = new Map<Material, MeshLambertMaterial>();
  private readonly plain = new Map<Mesh, Mesh["material"]>();
  private readonly ink = new MeshBasicMaterial({ side: BackSide });

  /** `rim`: how wide outlines are, m. */
  constructor(rim: number) {
    this.ink.onBeforeCompile = (shader) => {
      shader.vertexShader = shader.vertexShader.replace(
        "#include <project_vertex>",
        `#include <project_vertex>
        mvPosition.xyz += ${rim.toExponential(6)} * normalize(normalMatrix * normal);
        gl_Position = projectionMatrix * mvPosition;`,
      );
    };
    this.ink.customProgramCacheKey = () => `outline ${rim}`;
  }

  /** Dresses a mesh: its materials are replaced. */
  dress(mesh: Mesh): void {
    const { material } = mesh;
    mesh.material = Array.isArray(material) ? material.map((one) => this.mattOf(one)) : this.mattOf(material);
    castShadow(mesh);
    mesh.add(new Mesh(outlineOf(mesh.geometry), this.ink));
  }

  /** Mixes a mesh that was dressed with a colour; null: none. */
  light(mesh: Mesh, colour: Color | null): void {
    const plain = this.plain.get(mesh) ?? (mesh.material as MeshLambertMaterial);
    this.plain.set(mesh, plain);
    if (colour === null) mesh.material = plain;
    else
      mesh.material = Array.isArray(plain) ? plain.map((one) => this.glowOf(one, colour)) : this.glowOf(plain, colour);
  }

  dispose(): void {
    for (const material of this.glow.values()) material.dispose();
  }

  private glowOf(plain: Material, colour: Color): MeshLambertMaterial {
    const glow = this.glow.get(plain) ?? (plain as MeshLambertMaterial).clone();
    this.glow.set(plain, glow);
    glow.color.copy((plain as MeshLambertMaterial).color).lerp(colour, lightness);
    return glow;
  }

  /** Takes the colours of the page, light or dark. */
  paint(): void {
    const light = new Color(resolved("--mesh"));
    for (const { material, colour } of this.matt.values()) material.color.copy(colour).multiply(light);
    this.ink.color = new Color(resolved("--ink"));
  }

  private mattOf(from: Material): MeshLambertMaterial {
    const known = this.matt.get(from);
    if (known) return known.material;
    const { color = new Color(1, 1, 1), map = null, vertexColors } = from as Partial<MeshPhongMaterial>;
    const { transparent, opacity, alphaTest, side } = from;
    const coloured = vertexColors === true;
    const material = new MeshLambertMaterial({
      map,
      transparent,
      opacity,
      alphaTest,
      side,
      vertexColors: coloured,
    });
    from.dispose();
    this.matt.set(from, { material, colour: color.clone() });
    return material;
  }
}

/** The surface with one normal at each corner, so that outlines have no gaps at edges. */
function outlineOf(geometry: BufferGeometry): BufferGeometry {
  const corners = geometry.getAttribute("position");
  if (corners.count > mostMerged) return geometry;
  const bare = geometry.clone();
  for (const name of Object.keys(bare.attributes)) if (name !== "position") bare.deleteAttribute(name);
  const merged = mergeVertices(bare);
  merged.computeVertexNormals();
  return merged;
}
