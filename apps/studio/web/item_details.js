// SPDX-License-Identifier: Apache-2.0
//
// What the viewer tells of an item beyond its picture: scenes come without exact coordinates and sphere maps, which are
// asked for when somebody clicks.
import { askItem, ServerError } from "./server.js";
import { ARTIFICIAL } from "../../view/web/scene_data.js";

const ARRAYS = { directions: Int16Array, normals: Int16Array, circleNormals: Int16Array, dots: Uint32Array, arcs: Uint32Array,
  circles: Uint32Array, regions: Uint32Array };

// {exact, spheres} as a layer of a page has them, of which only this item's are there; null if it has none.
export async function itemDetails(page, { kind, layer: number, item }) {
  const layer = page.layers[number];
  const ends = { vertex: () => [item], edge: () => [...layer.edges.ends.subarray(2 * item, 2 * item + 2)], facet: () => [] }[kind]();
  const known = ends.filter((vertex) => layer.vertices.index[vertex] !== ARTIFICIAL);
  const facet = kind === "facet" && layer.facets.index[item] !== ARTIFICIAL ? layer.facets.index[item] : null;
  if (known.length === 0 && facet === null) return null;
  let found;
  try {
    found = await askItem(page.number, { layer: number, vertices: known.map((vertex) => layer.vertices.index[vertex]), facet });
  } catch (error) {
    if (error instanceof ServerError) return null; // another scene is on its way
    throw error;
  }
  const points = {};
  known.forEach((vertex, i) => (points[vertex] = found.points[i]));
  const spheres = Object.fromEntries(Object.entries(ARRAYS).map(([name, type]) => [name, type.from(found.spheres[name])]));
  spheres.begin = {};
  known.forEach((vertex, i) => {
    for (let k = 0; k < 8; ++k) spheres.begin[4 * vertex + k] = found.spheres.begin[4 * i + k];
  });
  return { exact: { points: () => points, planes: () => ({ [item]: found.plane }) }, spheres: kind === "vertex" ? spheres : null };
}
