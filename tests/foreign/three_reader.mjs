// SPDX-License-Identifier: Apache-2.0
//
// What gltf-validator and three.js make of files: node three_reader.mjs MODULES FILE..., a line of JSON each.
// MODULES is a folder node_modules that holds both; of it, those that are missing are left out.
import { existsSync, readFileSync } from "node:fs";
import { pathToFileURL } from "node:url";

const [modules, ...files] = process.argv.slice(2);
const load = (path) => import(pathToFileURL(`${modules}/${path}`).href);

// The sum of the signed volumes of the tetrahedra between the origin of the box and each triangle.
function measure(object, THREE) {
  object.updateMatrixWorld(true);
  const box = new THREE.Box3().setFromObject(object);
  const middle = box.isEmpty() ? new THREE.Vector3() : box.getCenter(new THREE.Vector3());
  let volume = 0;
  let triangles = 0;
  object.traverse((part) => {
    if (!part.isMesh) return;
    const points = part.geometry.attributes.position;
    const index = part.geometry.index;
    const count = index ? index.count : points ? points.count : 0;
    const corner = (i) =>
      new THREE.Vector3().fromBufferAttribute(points, index ? index.getX(i) : i).applyMatrix4(part.matrixWorld).sub(middle);
    for (let i = 0; i + 2 < count; i += 3) {
      volume += corner(i).dot(corner(i + 1).clone().cross(corner(i + 2))) / 6;
      ++triangles;
    }
  });
  return { volume, triangles, middle: middle.toArray() };
}

const bytes = (file) => {
  const data = readFileSync(file);
  return data.buffer.slice(data.byteOffset, data.byteOffset + data.byteLength);
};

const validator = existsSync(`${modules}/gltf-validator`) ? (await load("gltf-validator/index.js")).default : null;
const THREE = existsSync(`${modules}/three`) ? await load("three/build/three.module.js") : null;
for (const file of files) {
  const answer = { file };
  const extension = file.split(".").pop();
  if (validator && extension === "glb") {
    const { issues } = await validator.validateBytes(new Uint8Array(bytes(file)));
    answer.issues = issues.messages.filter((m) => m.severity < 2).map((m) => `${m.code}: ${m.message}`);
  }
  if (THREE) {
    const loaders = {
      glb: async () => {
        const { GLTFLoader } = await load("three/examples/jsm/loaders/GLTFLoader.js");
        return (await new GLTFLoader().parseAsync(bytes(file), "")).scene;
      },
      obj: async () => {
        const { OBJLoader } = await load("three/examples/jsm/loaders/OBJLoader.js");
        return new OBJLoader().parse(readFileSync(file, "utf8"));
      },
      stl: async () => {
        const { STLLoader } = await load("three/examples/jsm/loaders/STLLoader.js");
        return new THREE.Mesh(new STLLoader().parse(bytes(file)));
      },
      ply: async () => {
        const { PLYLoader } = await load("three/examples/jsm/loaders/PLYLoader.js");
        return new THREE.Mesh(new PLYLoader().parse(bytes(file)));
      },
    };
    if (loaders[extension]) {
      try {
        Object.assign(answer, measure(await loaders[extension](), THREE));
      } catch (error) {
        answer.error = String(error);
      }
    }
  }
  console.log(JSON.stringify(answer));
}
