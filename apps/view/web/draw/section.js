// SPDX-License-Identifier: Apache-2.0
//
// The section plane: cuts all layers and fills the cut of what is selected. Filling: the boundary of each volume is drawn
// into the stencil buffer, +1 for back faces and -1 for front faces, so that it is not zero where the plane is seen
// inside the volume.
import * as THREE from "three";
import { rgbOf } from "./layer_view.js";

const MOST_CAPS = 12; // volumes of a layer that get a cap of their own colour; more share one

// The boundary of the volumes for which inside(volume) holds, turned so that they lie behind it.
function boundaryGeometry(layer, inside) {
  const { begin, corners, above, below } = layer.facets;
  const index = [];
  for (let f = 0; f + 1 < begin.length; ++f) {
    const up = inside(above[f]);
    if (up === inside(below[f])) continue;
    for (let i = 3 * begin[f]; i < 3 * begin[f + 1]; i += 3) {
      index.push(corners[i], corners[i + (up ? 2 : 1)], corners[i + (up ? 1 : 2)]);
    }
  }
  const geometry = new THREE.BufferGeometry();
  geometry.setAttribute("position", new THREE.BufferAttribute(layer.vertices.xyz, 3));
  geometry.setIndex(index);
  return geometry;
}

function stencilMaterial(shared, side, operation) {
  return new THREE.ShaderMaterial({
    uniforms: { ...shared },
    side,
    colorWrite: false,
    depthWrite: false,
    depthTest: false,
    stencilWrite: true,
    stencilZPass: operation,
    vertexShader: `
varying vec3 vWorld;
void main() {
  vec4 world = modelMatrix * vec4(position, 1.0);
  vWorld = world.xyz;
  gl_Position = projectionMatrix * viewMatrix * world;
}`,
    fragmentShader: `
uniform vec4 section;
varying vec3 vWorld;
void main() {
  if (dot(section.xyz, vWorld) + section.w > 0.0) discard;
  gl_FragColor = vec4(1.0);
}`,
  });
}

function capMaterial(shared, hex) {
  return new THREE.ShaderMaterial({
    uniforms: { ...shared, color: { value: new THREE.Vector3(...rgbOf(hex).map((c) => c / 255)) } },
    side: THREE.DoubleSide,
    stencilWrite: true,
    stencilFunc: THREE.NotEqualStencilFunc,
    stencilRef: 0,
    polygonOffset: true,
    polygonOffsetFactor: 1,
    polygonOffsetUnits: 1,
    vertexShader: "void main() { gl_Position = projectionMatrix * viewMatrix * modelMatrix * vec4(position, 1.0); }",
    fragmentShader: `
uniform vec3 color;
uniform float ratio;
void main() {
  float stripe = mod((gl_FragCoord.x - gl_FragCoord.y) / ratio, 7.0);
  gl_FragColor = vec4(mix(color, vec3(1.0), stripe < 1.4 ? 0.25 : 0.55), 1.0);
}`,
  });
}

export class Section {
  // before: the section of the scene before, whose plane stays.
  constructor(views, shared, radius, before) {
    Object.assign(this, { views, shared, radius });
    this.on = before?.on ?? false;
    this.normal = before?.normal ?? new THREE.Vector3(1, 0, 0);
    this.offset = before?.offset ?? 0; // of the plane from the centre, in units of the radius
    this.caps = [];
  }

  // Caps are made at the first section: most visitors never ask for one.
  #makeCaps() {
    const pieces = new Map(); // views by the name of their layer: only together their boundaries are closed
    for (const view of this.views) {
      const { layer } = view;
      const selected = layer.volumes.flatMap((volume, v) => (volume.mark ? [v] : []));
      if (layer.piece) {
        if (!pieces.has(layer.name)) pieces.set(layer.name, []);
        pieces.get(layer.name).push([view, boundaryGeometry(layer, (v) => selected.includes(v))]);
        continue;
      }
      const groups = selected.length <= MOST_CAPS ? selected.map((v) => [v]) : [selected];
      for (const group of groups) {
        const inside = (v) => group.includes(v);
        const many = group.length > 1 ? new Set(group) : null;
        this.#makeCap([[view, boundaryGeometry(layer, many ? (v) => many.has(v) : inside)]],
          group.length > 1 ? layer.color : layer.volumes[group[0]].color);
      }
    }
    for (const some of pieces.values()) this.#makeCap(some, some[0][0].layer.color);
  }

  // solids: [view, geometry], which bound what the cap fills.
  #makeCap(solids, color) {
    const order = 10 + 3 * this.caps.length;
    const back = stencilMaterial(this.shared, THREE.BackSide, THREE.IncrementWrapStencilOp);
    const front = stencilMaterial(this.shared, THREE.FrontSide, THREE.DecrementWrapStencilOp);
    const walls = solids.map(([view, geometry]) => ({ view, meshes: [back, front].map((material) => new THREE.Mesh(geometry, material)) }));
    const cap = new THREE.Mesh(new THREE.PlaneGeometry(8 * this.radius, 8 * this.radius), capMaterial(this.shared, color));
    for (const { meshes } of walls) meshes.forEach((mesh, i) => (mesh.renderOrder = order + i));
    cap.renderOrder = order + 2;
    cap.onAfterRender = (renderer) => renderer.clearStencil();
    const parts = [...walls.flatMap(({ meshes }) => meshes), cap];
    for (const part of parts) part.frustumCulled = false;
    this.caps.push({ walls, cap, parts });
    this.group?.add(...parts);
  }

  addTo(scene) {
    this.group = new THREE.Group();
    scene.add(this.group);
  }

  update() {
    const distance = this.offset * this.radius;
    const { section } = this.shared;
    if (this.on) section.value.set(this.normal.x, this.normal.y, this.normal.z, -distance);
    else section.value.set(0, 0, 0, -1);
    if (this.on && this.caps.length === 0) this.#makeCaps();
    for (const { walls, cap } of this.caps) {
      for (const { view, meshes } of walls) {
        for (const mesh of meshes) {
          mesh.visible = this.on && view.group.visible && view.facets.visible;
          mesh.position.copy(view.group.position);
          mesh.quaternion.copy(view.group.quaternion);
        }
      }
      cap.visible = walls.some(({ meshes }) => meshes[0].visible);
      cap.position.copy(this.normal).multiplyScalar(distance);
      cap.quaternion.setFromUnitVectors(new THREE.Vector3(0, 0, 1), this.normal);
    }
  }

  // Frees what the graphics card has of it.
  dispose() {
    this.group.removeFromParent();
    for (const { parts } of this.caps) {
      for (const part of parts) {
        part.geometry.dispose();
        part.material.dispose();
      }
    }
  }

  // True if a point was cut away.
  cuts(point) {
    const { x, y, z, w } = this.shared.section.value;
    return x * point[0] + y * point[1] + z * point[2] + w > 0;
  }
}
