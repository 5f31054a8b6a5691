// SPDX-License-Identifier: Apache-2.0
//
// Which item is under the pointer: the nearest vertex within a few pixels, else edge, else facet, of those that are shown
// and not hidden by a facet or cut away.
import * as THREE from "three";
import { originOf, ORIGIN_OWN } from "./scene_data.js";
import { add3, cross3, dot3, scale3, sub3 } from "./vectors.js";

const VERTEX_REACH = 11;
const EDGE_REACH = 7;

// The ray's parameter where it meets a triangle; Infinity if it does not.
export function hitTriangle(origin, direction, a, b, c) {
  const ab = sub3(b, a);
  const ac = sub3(c, a);
  const p = cross3(direction, ac);
  const determinant = dot3(ab, p);
  if (determinant === 0) return Infinity;
  const s = sub3(origin, a);
  const u = dot3(s, p) / determinant;
  if (u < 0 || u > 1) return Infinity;
  const q = cross3(s, ab);
  const v = dot3(direction, q) / determinant;
  if (v < 0 || u + v > 1) return Infinity;
  const t = dot3(ac, q) / determinant;
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

  vertexPoint(view, vertex) {
    const { x, y, z } = view.group.position;
    return add3(Array.from(view.layer.vertices.xyz.subarray(3 * vertex, 3 * vertex + 3)), [x, y, z]);
  }

  #ray(x, y) {
    const ndc = [(x / this.canvas.clientWidth) * 2 - 1, 1 - (y / this.canvas.clientHeight) * 2];
    const far = new THREE.Vector3(...ndc, 0.5).unproject(this.camera);
    const forward = this.camera.getWorldDirection(new THREE.Vector3());
    const origin = this.camera.position.toArray();
    const direction = far.sub(this.camera.position);
    // Scaled so that the parameter is the depth.
    return { origin, direction: direction.multiplyScalar(1 / direction.dot(forward)).toArray() };
  }

  #facet(x, y) {
    const { origin, direction } = this.#ray(x, y);
    let best = { depth: Infinity };
    this.views.forEach((view, layer) => {
      if (!view.group.visible || !view.facets.visible) return;
      const { begin, corners } = view.layer.facets;
      const from = sub3(origin, view.group.position.toArray());
      const { xyz } = view.layer.vertices;
      const at = (i) => [xyz[3 * corners[i]], xyz[3 * corners[i] + 1], xyz[3 * corners[i] + 2]];
      for (let f = 0; f + 1 < begin.length; ++f) {
        for (let i = 3 * begin[f]; i < 3 * begin[f + 1]; i += 3) {
          const t = hitTriangle(from, direction, at(i), at(i + 1), at(i + 2));
          if (t >= best.depth || this.section.cuts(add3(origin, scale3(direction, t)))) continue;
          best = { kind: "facet", layer, item: f, depth: t, solid: view.opacity.value > 0.995 };
        }
      }
    });
    return best;
  }

  // {kind, layer, item} or null.
  pick(x, y) {
    const facet = this.#facet(x, y);
    // A little behind the facet is still on it: the reach is in pixels, and facets slope.
    const behind = facet.solid ? facet.depth * 1.02 : Infinity;
    return this.#nearestVertex(x, y, behind) ?? this.#nearestEdge(x, y, behind) ?? (facet.kind ? facet : null);
  }

  #nearestVertex(x, y, behind) {
    let best = null;
    let reach = VERTEX_REACH;
    this.views.forEach((view, layer) => {
      if (!view.group.visible || !view.vertices.visible) return;
      view.layer.vertices.flags.forEach((flags, item) => {
        if (originOf(flags) !== ORIGIN_OWN) return;
        const point = this.vertexPoint(view, item);
        const [px, py, depth] = this.project(point);
        const distance = Math.hypot(px - x, py - y);
        if (distance >= reach || depth <= 0 || depth > behind || this.section.cuts(point)) return;
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
      if (!view.group.visible || !view.edges.visible) return;
      const { ends } = view.layer.edges;
      const projected = new Map();
      const at = (vertex) => {
        if (!projected.has(vertex)) projected.set(vertex, this.project(this.vertexPoint(view, vertex)));
        return projected.get(vertex);
      };
      for (let item = 0; 2 * item < ends.length; ++item) {
        const a = at(ends[2 * item]);
        const b = at(ends[2 * item + 1]);
        if (a[2] <= 0 || b[2] <= 0) continue;
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
