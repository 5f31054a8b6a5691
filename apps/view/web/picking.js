// SPDX-License-Identifier: Apache-2.0
//
// Which item is under the pointer: the nearest vertex within a few pixels, else edge, else facet, of those that are shown
// and not hidden by a facet or cut away.
import * as THREE from "three";
import { originOf, ORIGIN_OWN } from "./scene_data.js";
import { add3, scale3, sub3 } from "./vectors.js";

const VERTEX_REACH = 11;
const EDGE_REACH = 7;

// The ray's parameter where it meets the triangle of three vertices; Infinity if it does not (Moeller and Trumbore 1997).
// Written out in numbers: it runs for every triangle at every click.
export function hitTriangle([ox, oy, oz], [dx, dy, dz], xyz, i, j, k) {
  const ax = xyz[3 * i], ay = xyz[3 * i + 1], az = xyz[3 * i + 2];
  const ux = xyz[3 * j] - ax, uy = xyz[3 * j + 1] - ay, uz = xyz[3 * j + 2] - az;
  const vx = xyz[3 * k] - ax, vy = xyz[3 * k + 1] - ay, vz = xyz[3 * k + 2] - az;
  const px = dy * vz - dz * vy, py = dz * vx - dx * vz, pz = dx * vy - dy * vx;
  const determinant = ux * px + uy * py + uz * pz;
  if (determinant === 0) return Infinity;
  const sx = ox - ax, sy = oy - ay, sz = oz - az;
  const u = (sx * px + sy * py + sz * pz) / determinant;
  if (u < 0 || u > 1) return Infinity;
  const qx = sy * uz - sz * uy, qy = sz * ux - sx * uz, qz = sx * uy - sy * ux;
  const v = (dx * qx + dy * qy + dz * qz) / determinant;
  if (v < 0 || u + v > 1) return Infinity;
  const t = (vx * qx + vy * qy + vz * qz) / determinant;
  return t > 0 ? t : Infinity;
}

export class Picker {
  constructor(views, section, camera, canvas) {
    Object.assign(this, { views, section, camera, canvas });
  }

  // Pixels and depth of a point: [x, y, distance along the view].
  project(point) {
    const eye = new THREE.Vector3(...point).applyMatrix4(this.camera.matrixWorldInverse);
    const depth = -eye.z;
    eye.applyMatrix4(this.camera.projectionMatrix);
    return [((eye.x + 1) / 2) * this.canvas.clientWidth, ((1 - eye.y) / 2) * this.canvas.clientHeight, depth];
  }

  // The same for all vertices of a layer, three numbers each.
  #projectAll(view) {
    const matrix = view.matrix().clone().premultiply(this.camera.matrixWorldInverse);
    const m = matrix.elements;
    const p = this.camera.projectionMatrix.elements;
    const [w, h] = [this.canvas.clientWidth / 2, this.canvas.clientHeight / 2];
    const { xyz } = view.layer.vertices;
    const result = new Float64Array(xyz.length);
    for (let i = 0; i < xyz.length; i += 3) {
      const x = xyz[i], y = xyz[i + 1], z = xyz[i + 2];
      const depth = -(m[2] * x + m[6] * y + m[10] * z + m[14]);
      result[i] = w * (1 + (p[0] * (m[0] * x + m[4] * y + m[8] * z + m[12])) / depth);
      result[i + 1] = h * (1 - (p[5] * (m[1] * x + m[5] * y + m[9] * z + m[13])) / depth);
      result[i + 2] = depth;
    }
    return result;
  }

  vertexPoint(view, vertex) {
    return new THREE.Vector3().fromArray(view.layer.vertices.xyz, 3 * vertex).applyMatrix4(view.matrix()).toArray();
  }

  // The ray of a pixel, whose parameter is the depth.
  ray(x, y) {
    const ndc = [(x / this.canvas.clientWidth) * 2 - 1, 1 - (y / this.canvas.clientHeight) * 2];
    const far = new THREE.Vector3(...ndc, 0.5).unproject(this.camera);
    const forward = this.camera.getWorldDirection(new THREE.Vector3());
    const origin = this.camera.position.toArray();
    const direction = far.sub(this.camera.position);
    return { origin, direction: direction.multiplyScalar(1 / direction.dot(forward)).toArray() };
  }

  // The nearest facet of each layer under a pixel: {kind, layer, item, depth, solid}, the nearest one first.
  facets(x, y) {
    const { origin, direction } = this.ray(x, y);
    return this.views.flatMap((view, layer) => {
      if (!view.group.visible || !view.facets.visible) return [];
      let best = { depth: Infinity };
      const { begin, corners } = view.layer.facets;
      // The ray in the layer's coordinates.
      const back = view.matrix().clone().invert();
      const from = new THREE.Vector3(...origin).applyMatrix4(back).toArray();
      const along = sub3(new THREE.Vector3(...add3(origin, direction)).applyMatrix4(back).toArray(), from);
      const { xyz } = view.layer.vertices;
      for (let f = 0; f + 1 < begin.length; ++f) {
        for (let i = 3 * begin[f]; i < 3 * begin[f + 1]; i += 3) {
          const t = hitTriangle(from, along, xyz, corners[i], corners[i + 1], corners[i + 2]);
          if (t >= best.depth || this.section.cuts(add3(origin, scale3(direction, t)))) continue;
          best = { kind: "facet", layer, item: f, depth: t, solid: view.opacity.value > 0.995 };
        }
      }
      return best.kind ? [best] : [];
    }).sort((a, b) => a.depth - b.depth);
  }

  // {kind, layer, item} or null.
  pick(x, y) {
    const facet = this.facets(x, y)[0] ?? { depth: Infinity };
    // A little behind the facet is still on it: the reach is in pixels, and facets slope.
    const behind = facet.solid ? facet.depth * 1.02 : Infinity;
    return this.#nearestVertex(x, y, behind) ?? this.#nearestEdge(x, y, behind) ?? (facet.kind ? facet : null);
  }

  #nearestVertex(x, y, behind) {
    let best = null;
    let reach = VERTEX_REACH;
    this.views.forEach((view, layer) => {
      if (!view.group.visible || !view.shown.vertices) return;
      const projected = this.#projectAll(view);
      view.layer.vertices.flags.forEach((flags, item) => {
        const depth = projected[3 * item + 2];
        if (originOf(flags) !== ORIGIN_OWN || !(depth > 0) || depth > behind) return;
        const distance = Math.hypot(projected[3 * item] - x, projected[3 * item + 1] - y);
        if (distance >= reach || this.section.cuts(this.vertexPoint(view, item))) return;
        reach = distance;
        best = { kind: "vertex", layer, item };
      });
    });
    return best;
  }

  #nearestEdge(x, y, behind) {
    let best = null;
    let reach = EDGE_REACH;
    this.views.forEach((view, layer) => {
      if (!view.group.visible || !view.shown.edges) return;
      const { ends } = view.layer.edges;
      const projected = this.#projectAll(view);
      for (let item = 0; 2 * item < ends.length; ++item) {
        const i = 3 * ends[2 * item];
        const j = 3 * ends[2 * item + 1];
        // Most edges are far away.
        if (Math.min(projected[i], projected[j]) > x + reach || Math.max(projected[i], projected[j]) < x - reach ||
          Math.min(projected[i + 1], projected[j + 1]) > y + reach || Math.max(projected[i + 1], projected[j + 1]) < y - reach) continue;
        const a = projected.subarray(i, i + 3);
        const b = projected.subarray(j, j + 3);
        if (!(a[2] > 0 && b[2] > 0)) continue;
        const [dx, dy] = [b[0] - a[0], b[1] - a[1]];
        const square = dx * dx + dy * dy;
        const t = square > 0 ? Math.min(1, Math.max(0, ((x - a[0]) * dx + (y - a[1]) * dy) / square)) : 0;
        const distance = Math.hypot(a[0] + t * dx - x, a[1] + t * dy - y);
        if (distance >= reach) continue;
        // Depth is not linear on the screen, but its inverse is.
        const depth = 1 / ((1 - t) / a[2] + t / b[2]);
        if (depth > behind) continue;
        const s = square > 0 ? (t * depth) / b[2] : 0;
        const p = this.vertexPoint(view, ends[2 * item]);
        const q = this.vertexPoint(view, ends[2 * item + 1]);
        if (this.section.cuts(add3(scale3(p, 1 - s), scale3(q, s)))) continue;
        reach = distance;
        best = { kind: "edge", layer, item };
      }
    });
    return best;
  }
}
