/** Mesh files for tests: a box of edges 0.1, 0.2, 0.3 in each format. */
type Corner = [number, number, number];

const corners: Corner[] = [0, 1, 2, 3, 4, 5, 6, 7].map((i) => [0.1 * (i & 1), 0.1 * (i & 2), 0.075 * (i & 4)]);
const faces = [
  [0, 2, 1],
  [1, 2, 3],
  [4, 5, 6],
  [5, 7, 6],
  [0, 1, 4],
  [1, 5, 4],
  [2, 6, 3],
  [3, 6, 7],
  [0, 4, 2],
  [2, 4, 6],
  [1, 3, 5],
  [3, 7, 5],
];

export function binaryStl(): Buffer {
  const bytes = Buffer.alloc(84 + 50 * faces.length);
  bytes.writeUInt32LE(faces.length, 80);
  faces.forEach((face, i) =>
    face.forEach((corner, k) =>
      (corners[corner] as Corner).forEach((value, m) => bytes.writeFloatLE(value, 84 + 50 * i + 12 + 12 * k + 4 * m)),
    ),
  );
  return bytes;
}

export function textStl(): Buffer {
  const facets = faces.map((face) => {
    const lines = face.map((corner) => `vertex ${(corners[corner] as Corner).join(" ")}`);
    return `facet normal 0 0 1\nouter loop\n${lines.join("\n")}\nendloop\nendfacet`;
  });
  return Buffer.from(`solid box\n${facets.join("\n")}\nendsolid box\n`);
}

export function obj(): Buffer {
  const lines = [
    "mtllib http://elsewhere.invalid/box.mtl",
    ...corners.map((corner) => `v ${corner.join(" ")}`),
    ...faces.map((face) => `f ${face.map((i) => i + 1).join(" ")}`),
  ];
  return Buffer.from(lines.join("\n"));
}

/** With its z axis up, in millimetres, and a picture that another server has. */
export function collada(): Buffer {
  const numbers = corners.flat().map((value) => 1000 * value);
  return Buffer.from(`<?xml version="1.0"?>
<COLLADA xmlns="http://www.collada.org/2005/11/COLLADASchema" version="1.4.1">
  <asset><unit name="millimeter" meter="0.001"/><up_axis>Z_UP</up_axis></asset>
  <library_images><image id="i"><init_from>http://elsewhere.invalid/wood.png</init_from></image></library_images>
  <library_effects><effect id="e"><profile_COMMON>
    <newparam sid="s"><surface type="2D"><init_from>i</init_from></surface></newparam>
    <newparam sid="t"><sampler2D><source>s</source></sampler2D></newparam>
    <technique sid="c"><lambert><diffuse><texture texture="t" texcoord="UV"/></diffuse></lambert></technique>
  </profile_COMMON></effect></library_effects>
  <library_materials><material id="m"><instance_effect url="#e"/></material></library_materials>
  <library_geometries><geometry id="g"><mesh>
    <source id="p"><float_array id="a" count="${numbers.length}">${numbers.join(" ")}</float_array>
      <technique_common><accessor source="#a" count="${corners.length}" stride="3">
        <param name="X" type="float"/><param name="Y" type="float"/><param name="Z" type="float"/>
      </accessor></technique_common></source>
    <vertices id="v"><input semantic="POSITION" source="#p"/></vertices>
    <triangles material="m" count="${faces.length}"><input semantic="VERTEX" source="#v" offset="0"/>
      <p>${faces.flat().join(" ")}</p></triangles>
  </mesh></geometry></library_geometries>
  <library_visual_scenes><visual_scene id="w"><node id="n"><instance_geometry url="#g"><bind_material><technique_common>
    <instance_material symbol="m" target="#m"/></technique_common></bind_material></instance_geometry></node>
  </visual_scene></library_visual_scenes>
  <scene><instance_visual_scene url="#w"/></scene>
</COLLADA>`);
}

const joint = (name: string, type: string, parent: string, child: string, inside: string): string =>
  `<joint name="${name}" type="${type}"><parent link="${parent}"/><child link="${child}"/>${inside}</joint>`;
const visual = (file: string, origin: string, scale = ""): string =>
  `<visual><origin ${origin}/><geometry><mesh filename="${file}" ${scale}/></geometry>` +
  '<material name="red"><color rgba="0.8 0.2 0.2 1"/></material></visual>';

/** An arm of four joints, the last a mimic of the second, with a fixed sensor on the second link and a finger that is
 * not on the chain. */
export const urdf = `<robot name="meshed">
  <link name="base">${visual("package://t/meshes/base.stl", 'xyz="0.1 0 -0.05" rpy="0 0 0.5"')}</link>
  <link name="upper">${visual("package://t/meshes/upper.dae", 'xyz="0 0.02 0.1" rpy="0.3 -0.2 0.1"')}</link>
  <link name="fore">${visual("meshes/fore.obj", 'xyz="0 0 0"', 'scale="2 1 0.5"')}
    ${visual("package://t/meshes/gone.stl", 'xyz="0 0 0"')}</link>
  <link name="sensor">${visual("file:///somewhere/t/meshes/sensor.STL", 'xyz="0 0 0.03" rpy="1.2 0 0"')}</link>
  <link name="wrist"/>
  <link name="tool0">${visual("package://t/other/base.stl", 'xyz="0 0 0.1"')}</link>
  <link name="finger"/>
  ${joint("j1", "revolute", "base", "upper", '<origin xyz="0 0 0.4"/><axis xyz="0 0 1"/><limit lower="-3" upper="3"/>')}
  ${joint("j2", "revolute", "upper", "fore", '<origin xyz="0 0.1 0.5" rpy="0.1 0.2 0.3"/><axis xyz="0 1 0"/><limit lower="-3" upper="3"/>')}
  ${joint("j3", "prismatic", "fore", "wrist", '<origin xyz="0 0 0.4"/><limit lower="0" upper="0.3"/>')}
  ${joint("j4", "continuous", "wrist", "tool0", '<axis xyz="0 0 1"/><mimic joint="j2" multiplier="-0.5" offset="0.1"/>')}
  ${joint("f1", "fixed", "fore", "sensor", '<origin xyz="0.1 0 0.2" rpy="0 0.4 0"/>')}
  ${joint("f2", "prismatic", "sensor", "finger", '<axis xyz="0 1 0"/><limit lower="0" upper="0.04"/><mimic joint="f3"/>')}
  ${joint("f3", "prismatic", "sensor", "thumb", '<axis xyz="0 1 0"/><limit lower="0" upper="0.04"/>')}
  <link name="thumb"/>
</robot>`;
