// SPDX-License-Identifier: Apache-2.0
//
// What the page tells about an item, as HTML.
import { ARTIFICIAL, isolated } from "./scene_data.js";

export const escaped = (text) => String(text).replace(/[&<>"]/g, (c) => `&#${c.charCodeAt(0)};`);
const row = (name, value, exact = false) => `<tr><td>${name}</td><td${exact ? ' class="exact"' : ""}>${value}</td></tr>`;
const plural = (count, one) => `${count} ${one}${count === 1 ? "" : "s"}`;

export function markBadge(mark) {
  const label = mark > 1 ? ` (label ${mark})` : "";
  return `<span class="mark ${mark ? "in" : "out"}">${mark ? "selected" : "not selected"}${label}</span>`;
}

// What nobody reads at a glance has the nearest decimal beside it.
function exactNumber(text, about) {
  const decimal = text.includes("/") || text.length > 12 ? ` <span class="about">&asymp; ${Number(about.toPrecision(7))}</span>` : "";
  return `<span class="number">${escaped(text)}</span>${decimal}`;
}

function pointRows(page, layer, exact, vertex) {
  const line = exact?.points()[vertex];
  const { xyz } = layer.vertices;
  const about = (i) => xyz[3 * vertex + i] + page.center[i] + (layer.offset?.[i] ?? 0);
  if (line) return line.split(" ").map((text, i) => row("xyz"[i], exactNumber(text, about(i)), true)).join("");
  const near = [0, 1, 2].map((i) => about(i).toPrecision(7)).join(", ");
  return row("point", `about ${near}`) + row("", exact ? "on the visible box" : "exact texts were left out of this page");
}

function planeText(line) {
  const terms = line.split(" ").map((factor, i) => [factor, [" x", " y", " z", ""][i]]).filter(([factor]) => factor !== "0");
  const shown = ([factor, name]) => (name && /^-?1$/.test(factor) ? factor.replace("1", "") + name.trim() : factor + name);
  return `${terms.map(shown).join(" + ").replaceAll("+ -", "- ")} = 0`;
}

function volumeText(layer, v) {
  const { index, mark, bounded } = layer.volumes[v];
  const name = index === null || layer.piece ? "" : `${index} `;
  return `${name}${markBadge(mark)}${bounded ? "" : " unbounded"}`;
}

export function itemText(page, { kind, layer: l, item, details }) {
  const layer = page.layers[l];
  const exact = details?.exact ?? layer.exact;
  // Items of pieces have numbers that mean nothing outside.
  const index = (i) => (i === ARTIFICIAL ? "none: made by the visible box or the section" : layer.piece ? "" : i);
  let title = kind;
  let rows = row("layer", escaped(layer.name));
  if (kind === "vertex") {
    const { vertices } = layer;
    const spheres = details?.spheres ?? layer.spheres;
    title = `Vertex ${index(vertices.index[item])}`;
    rows += row("mark", markBadge(vertices.mark[item])) + pointRows(page, layer, exact, item);
    const [dots, arcs, circles, regions] = [0, 1, 2, 3].map((k) => (spheres ? spheres.begin[4 * item + 4 + k] - spheres.begin[4 * item + k] : 0));
    if (spheres) rows += row("sphere map", [plural(dots, "svertex").replace("svertexs", "svertices"), plural(arcs, "sedge"),
      plural(circles, "sloop"), plural(regions, "sface")].join(", "));
    if (isolated(vertices.flags[item])) rows += row("", "isolated");
  } else if (kind === "edge") {
    const { edges } = layer;
    title = `Edge ${index(edges.index[item])}`;
    rows += row("mark", markBadge(edges.mark[item]));
    if (edges.twin[item] !== ARTIFICIAL && !layer.piece) rows += row("halfedges", `${edges.index[item]}, ${edges.twin[item]}`);
    if (isolated(edges.flags[item])) rows += row("", "bounds no facet");
    for (const end of [0, 1]) {
      const vertex = edges.ends[2 * item + end];
      rows += row(end ? "to" : "from", `vertex ${index(layer.vertices.index[vertex])}`) + pointRows(page, layer, exact, vertex);
    }
  } else {
    const { facets } = layer;
    title = `Facet ${index(facets.index[item])}`;
    rows += row("mark", markBadge(facets.mark[item]));
    const plane = exact?.planes()[item];
    if (plane) rows += row("plane", `<span class="number">${escaped(planeText(plane))}</span>`, true);
    rows += row("above", volumeText(layer, facets.above[item])) + row("below", volumeText(layer, facets.below[item]));
  }
  return `<h2>${title}</h2><table>${rows}</table>`;
}

export function sphereItemText(map, pick) {
  if (!pick) return "";
  const { kind, item } = pick;
  if (kind === "svertex") return `Svertex ${item}: halfedge ${map.dots[item].halfedge} ${markBadge(map.dots[item].mark)}`;
  if (kind === "sedge") {
    const { source, target, facet, mark } = map.arcs[item];
    return `Sedge ${item}: svertex ${source} to ${target}, facet ${facet} ${markBadge(mark)}`;
  }
  if (kind === "sloop") return `Sloop ${item}: facet ${map.circles[item].facet} ${markBadge(map.circles[item].mark)}`;
  return `Sface ${item}: volume ${map.regions[item].volume} ${markBadge(map.regions[item].mark)}`;
}
