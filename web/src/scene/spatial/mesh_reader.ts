import { LoadingManager, Mesh, type BufferGeometry, type Material, type Object3D } from "three";
import { ColladaLoader } from "three/addons/loaders/ColladaLoader.js";
import { OBJLoader } from "three/addons/loaders/OBJLoader.js";
import { STLLoader } from "three/addons/loaders/STLLoader.js";

const trianglesAt = 84; // bytes in front of a binary STL's triangles
const triangle = 50; // bytes

function stl(bytes: ArrayBuffer): BufferGeometry {
  const text = new TextDecoder().decode(bytes.slice(0, 5)) === "solid";
  const most = (bytes.byteLength - trianglesAt) / triangle;
  if (most < 0 || (!text && new DataView(bytes).getUint32(trianglesAt - 4, true) > most))
    throw new Error("it is no STL file, or cut off");
  return new STLLoader().parse(bytes);
}

function collada(bytes: ArrayBuffer, manager: LoadingManager): Object3D {
  const text = new TextDecoder().decode(bytes);
  const root = new DOMParser().parseFromString(text, "text/xml").documentElement;
  if (root.nodeName !== "COLLADA" || root.querySelector("parsererror"))
    throw new Error("it is no Collada file, or cut off");
  const scene = new ColladaLoader(manager).parse(text, "")?.scene;
  if (!scene) throw new Error("it has no scene");
  const others: Object3D[] = [];
  scene.traverse((part) => {
    if ("isLight" in part || "isCamera" in part) others.push(part);
  });
  for (const part of others) part.removeFromParent();
  return scene;
}

function object(name: string, bytes: ArrayBuffer, material: Material, manager: LoadingManager): Object3D {
  const ending = /\.([^.]*)$/.exec(name)?.[1]?.toLowerCase();
  if (ending === "stl") return new Mesh(stl(bytes), material);
  if (ending === "dae") return collada(bytes, manager);
  if (ending !== "obj") throw new Error("meshes are .stl, .dae or .obj files");
  const made = new OBJLoader(manager).parse(new TextDecoder().decode(bytes));
  made.traverse((part) => {
    if (part instanceof Mesh) part.material = material;
  });
  return made;
}

/** The mesh in a file; the manager resolves what else the file names. Throws an Error for what cannot be shown. */
export function readMesh(name: string, bytes: ArrayBuffer, material: Material, manager: LoadingManager): Object3D {
  const made = object(name, bytes, material, manager);
  let corners = 0;
  made.traverse((part) => {
    if (!(part instanceof Mesh)) return;
    const { array = [] } = (part.geometry as BufferGeometry).getAttribute("position") ?? {};
    for (const value of array) if (!Number.isFinite(value)) throw new Error("a position in it is not a number");
    corners += array.length / 3;
  });
  if (corners < 3) throw new Error("it has no triangles");
  return made;
}
