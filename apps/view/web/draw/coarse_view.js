// SPDX-License-Identifier: Apache-2.0
//
// Large layers in few triangles, for as long as something moves where frames take long. Corners that lie in one cell of a
// grid become one corner, and triangles that lose one vanish (vertex clustering: Rossignac and Borrel 1993). The corner of
// a cell is that of the first layer that has one there, so pieces of a layer still fit together, and only those that have
// changed are made anew.
import * as THREE from "three";
import { byLayer } from "./layer_view.js";

export const MOST_TRIANGLES = 8000; // of a scene that is always drawn whole; about as many are left of a larger one
const FEW_TRIANGLES = 2000; // of a layer that stays whole
const CELLS_OF_RADIUS = 28; // of the page, at first
const MOST_CELLS = 2 ** 17; // along an axis, so that a cell has one number
const MOST_SHIFT = 2 ** 14; // cells between the origin of a grid and the centre of the page

export const triangleCount = (view) => view.layer.facets.corners.length / 3;

// The corners of the cells of one grid, about an origin in space that is near all of them.
class CellCorners {
  constructor(side, origin) {
    Object.assign(this, { side, origin });
    this.numbers = new Map();
    this.corners = [];
  }

  // The number of the cell of a point. A new one gets the point as its corner.
  number(x, y, z) {
    const along = (t) => Math.floor(t / this.side) + MOST_CELLS / 2;
    const key = (along(x) * MOST_CELLS + along(y)) * MOST_CELLS + along(z);
    let number = this.numbers.get(key);
    if (number === undefined) {
      number = this.corners.length / 3;
      this.numbers.set(key, number);
      this.corners.push(x, y, z);
    }
    return number;
  }
}

// The triangles of a view that are left, as arrays of three corners each: position, in the layer's coordinates, and the
// attributes of the whole ones.
function coarseTriangles(view, cells) {
  const { xyz } = view.layer.vertices;
  const { corners } = view.layer.facets;
  // Layers without pieces have coordinates about the page's centre.
  const center = view.layer.piece ? view.layer.piece.center.map((x, i) => x - cells.origin[i]) : [0, 0, 0];
  const cellOf = new Uint32Array(xyz.length / 3);
  for (let v = 0; v < cellOf.length; ++v) {
    cellOf[v] = cells.number(xyz[3 * v] + center[0], xyz[3 * v + 1] + center[1], xyz[3 * v + 2] + center[2]);
  }
  const left = [];
  for (let i = 0; i < corners.length; i += 3) {
    const [a, b, c] = [cellOf[corners[i]], cellOf[corners[i + 1]], cellOf[corners[i + 2]]];
    if (a !== b && b !== c && c !== a) left.push(i, i + 1, i + 2);
  }
  const arrays = {};
  for (const [name, { array, itemSize }] of Object.entries(view.facets.geometry.attributes)) {
    const some = (arrays[name] = new array.constructor(left.length * itemSize));
    left.forEach((corner, i) => {
      const from = name === "position" ? 3 * cellOf[corners[corner]] : itemSize * corner;
      for (let k = 0; k < itemSize; ++k) {
        some[itemSize * i + k] = name === "position" ? cells.corners[from + k] - center[k] : array[from + k];
      }
    });
  }
  return { count: left.length / 3, arrays };
}

// One geometry of the triangles that are left of some views.
function joinedGeometry(views, radius) {
  const geometry = new THREE.BufferGeometry();
  const count = 3 * views.reduce((sum, { coarse }) => sum + coarse.count, 0);
  for (const [name, { array, itemSize, normalized }] of Object.entries(views[0].facets.geometry.attributes)) {
    const joined = new array.constructor(count * itemSize);
    let to = 0;
    for (const { coarse, layer } of views) {
      const some = coarse.arrays[name];
      joined.set(some, to);
      if (name === "position" && layer.piece) {
        for (let i = 0; i < some.length; ++i) joined[to + i] += layer.offset[i % 3];
      }
      to += some.length;
    }
    geometry.setAttribute(name, new THREE.BufferAttribute(joined, itemSize, normalized));
  }
  geometry.boundingSphere = new THREE.Sphere(new THREE.Vector3(), radius); // would be looked for
  return geometry;
}

export class CoarseView {
  constructor() {
    this.groups = []; // {views, mesh}
    this.cells = null;
  }

  // Makes few triangles of the large layers among these views, which are those of a scene in a page of this radius about
  // this centre. O(those that are new).
  show(views, radius, center) {
    this.dispose();
    const large = byLayer(views).filter((some) => some.reduce((sum, view) => sum + triangleCount(view), 0) > FEW_TRIANGLES);
    const finest = radius / CELLS_OF_RADIUS;
    const far = (cells) => Math.hypot(...center.map((x, i) => x - cells.origin[i])) > MOST_SHIFT * cells.side;
    if (!this.cells || this.cells.side < finest / 2 || this.cells.side > finest * 8 || far(this.cells)) {
      this.cells = new CellCorners(finest, center);
    }
    let count = this.#make(large.flat());
    while (count > 1.5 * MOST_TRIANGLES && this.cells.side < finest * 8) {
      this.cells = new CellCorners(this.cells.side * Math.sqrt(count / MOST_TRIANGLES), center);
      count = this.#make(large.flat());
    }
    this.groups = large.map((some) => {
      const mesh = new THREE.Mesh(joinedGeometry(some, radius), some[0].facets.material);
      mesh.frustumCulled = false;
      mesh.matrixAutoUpdate = false;
      mesh.visible = false;
      return { views: some, mesh };
    });
  }

  #make(views) {
    for (const view of views) {
      if (view.coarse?.cells === this.cells) continue;
      view.coarse = { cells: this.cells, ...coarseTriangles(view, this.cells) };
    }
    return views.reduce((sum, { coarse }) => sum + coarse.count, 0);
  }

  // Draws by `render` with few triangles in place of the whole layers.
  draw(scene, render) {
    for (const { views, mesh } of this.groups) {
      const [first] = views;
      const parent = first.layer.piece ? scene : first.group;
      if (mesh.parent !== parent) parent.add(mesh);
      mesh.visible = first.group.visible && first.facets.visible;
      for (const view of views) view.whole.visible = false;
    }
    render();
    for (const { views, mesh } of this.groups) {
      mesh.visible = false;
      for (const view of views) view.whole.visible = true;
    }
  }

  // Frees what the graphics card has of it. Materials are those of the views.
  dispose() {
    for (const { mesh } of this.groups) {
      mesh.removeFromParent();
      mesh.geometry.dispose();
    }
    this.groups = [];
  }
}
