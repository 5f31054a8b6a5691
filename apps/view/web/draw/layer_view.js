// SPDX-License-Identifier: Apache-2.0
//
// One layer of the scene as objects of three.js.
import * as THREE from "three";
import { isolated, originOf, ORIGIN_BOX, ORIGIN_OWN } from "../scene_data.js";
import { facetMaterial, lineMaterial, dotMaterial } from "./materials.js";

export const INK_HEX = "#1f3a5a";
export const ORANGE_HEX = "#d9662b";
const WHITE = [255, 255, 255];
const GREY = [150, 162, 174];
export const rgbOf = (hex) => [1, 3, 5].map((i) => parseInt(hex.slice(i, i + 2), 16));

const INK = rgbOf(INK_HEX);
const ORANGE = rgbOf(ORANGE_HEX);

// The volume whose colour a facet shows to an eye above or below it, and whether it is seen from within; the same rule as
// facet_side (apps/view/layer.h).
export function facetSide(layer, facet, fromAbove) {
  const { above, below } = layer.facets;
  const front = (fromAbove ? above : below)[facet];
  const behind = (fromAbove ? below : above)[facet];
  if (layer.volumes[behind].mark) return { volume: behind, inner: false };
  if (layer.volumes[front].mark) return { volume: front, inner: true };
  return { volume: null, inner: false };
}

function sideColor(layer, facet, fromAbove) {
  const { volume, inner } = facetSide(layer, facet, fromAbove);
  const rgb = rgbOf(volume === null ? layer.color : layer.volumes[volume].color);
  return inner ? rgb.map((c) => Math.round(c * 0.8)) : rgb;
}

function facetGeometry(layer) {
  const { begin, corners, mark, flags } = layer.facets;
  const { xyz } = layer.vertices;
  const position = new Float32Array(corners.length * 3);
  for (let i = 0; i < corners.length; ++i) {
    for (let k = 0; k < 3; ++k) position[3 * i + k] = xyz[3 * corners[i] + k];
  }
  // Four bytes as one number, least significant first, as on every machine with WebGL.
  const front = new Uint32Array(corners.length);
  const back = new Uint32Array(corners.length);
  const packed = new Map(); // the same colours come again and again
  const colorOf = (f, fromAbove, style) => {
    const { volume, inner } = facetSide(layer, f, fromAbove);
    const key = ((volume ?? -1) * 2 + (inner ? 1 : 0)) * 256 + style;
    if (!packed.has(key)) {
      const [r, g, b] = sideColor(layer, f, fromAbove);
      packed.set(key, ((style << 24) | (b << 16) | (g << 8) | r) >>> 0);
    }
    return packed.get(key);
  };
  for (let f = 0; f + 1 < begin.length; ++f) {
    const style = originOf(flags[f]) === ORIGIN_BOX ? 128 : mark[f] ? 0 : 255;
    front.fill(colorOf(f, true, style), 3 * begin[f], 3 * begin[f + 1]);
    back.fill(colorOf(f, false, style), 3 * begin[f], 3 * begin[f + 1]);
    if (layer.surface?.rgb && style === 0) {
      const { rgb } = layer.surface;
      for (let i = 3 * begin[f]; i < 3 * begin[f + 1]; ++i) {
        const [r, g, b] = rgb.subarray(3 * corners[i], 3 * corners[i] + 3);
        front[i] = back[i] = ((b << 16) | (g << 8) | r) >>> 0;
      }
    }
  }
  const geometry = new THREE.BufferGeometry();
  geometry.setAttribute("position", new THREE.BufferAttribute(position, 3));
  geometry.setAttribute("front", new THREE.BufferAttribute(new Uint8Array(front.buffer), 4, true));
  geometry.setAttribute("back", new THREE.BufferAttribute(new Uint8Array(back.buffer), 4, true));
  if (layer.surface?.places) geometry.setAttribute("place", new THREE.BufferAttribute(layer.surface.places, 2));
  return geometry;
}

// segments: {start: [x, y, z], end: [x, y, z], rgb, width}. Four vertices each rather than one instance of a quad: cards
// draw many tiny instances slowly, and a processor that stands in for one takes minutes for 100,000 of them.
export function lineMesh(segments, shared) {
  const count = 4 * segments.length;
  const corner = new Int8Array(count * 3);
  const start = new Float32Array(count * 3);
  const end = new Float32Array(count * 3);
  const color = new Uint8Array(count * 4);
  const width = new Float32Array(count);
  const index = new Uint32Array(6 * segments.length);
  segments.forEach((segment, i) => {
    for (let k = 0; k < 4; ++k) {
      const vertex = 4 * i + k;
      corner.set([k >> 1, k % 2 === 0 ? -1 : 1, 0], 3 * vertex);
      start.set(segment.start, 3 * vertex);
      end.set(segment.end, 3 * vertex);
      color.set(segment.rgb, 4 * vertex);
      width[vertex] = segment.width;
    }
    index.set([0, 2, 1, 1, 2, 3].map((k) => 4 * i + k), 6 * i);
  });
  const geometry = new THREE.BufferGeometry();
  geometry.setAttribute("position", new THREE.BufferAttribute(corner, 3));
  geometry.setIndex(new THREE.BufferAttribute(index, 1));
  geometry.setAttribute("start", new THREE.BufferAttribute(start, 3));
  geometry.setAttribute("end", new THREE.BufferAttribute(end, 3));
  geometry.setAttribute("color", new THREE.BufferAttribute(color, 4, true));
  geometry.setAttribute("width", new THREE.BufferAttribute(width, 1));
  const material = lineMaterial(shared);
  material.side = THREE.DoubleSide;
  const mesh = new THREE.Mesh(geometry, material);
  mesh.frustumCulled = false;
  return mesh;
}

// dots: {at: [x, y, z], fill, rim, diameter}
export function dotMesh(dots, shared) {
  const position = new Float32Array(dots.length * 3);
  const fill = new Uint8Array(dots.length * 4);
  const rim = new Uint8Array(dots.length * 4);
  const diameter = new Float32Array(dots.length);
  dots.forEach((dot, i) => {
    position.set(dot.at, 3 * i);
    fill.set(dot.fill, 4 * i);
    rim.set(dot.rim, 4 * i);
    diameter[i] = dot.diameter;
  });
  const geometry = new THREE.BufferGeometry();
  geometry.setAttribute("position", new THREE.BufferAttribute(position, 3));
  geometry.setAttribute("fill", new THREE.BufferAttribute(fill, 4, true));
  geometry.setAttribute("rim", new THREE.BufferAttribute(rim, 4, true));
  geometry.setAttribute("diameter", new THREE.BufferAttribute(diameter, 1));
  const points = new THREE.Points(geometry, dotMaterial(shared));
  points.frustumCulled = false;
  return points;
}

export const lineColor = (selected) => (selected ? INK : ORANGE);
export const dotColors = (selected) => (selected ? { fill: INK, rim: INK } : { fill: WHITE, rim: ORANGE });

// Edges shorter than this many pixels cover the facets between them.
const DENSE = 5;

// The mean length of the edges in pixels, about, when the whole page is seen: dense meshes get finer lines and dots.
function meanLength(layer, radius) {
  const { ends } = layer.edges;
  const { xyz } = layer.vertices;
  let sum = 0;
  for (let i = 0; i < ends.length; i += 2) {
    const [a, b] = [3 * ends[i], 3 * ends[i + 1]];
    sum += Math.hypot(xyz[a] - xyz[b], xyz[a + 1] - xyz[b + 1], xyz[a + 2] - xyz[b + 2]);
  }
  return ends.length === 0 ? Infinity : (sum / (ends.length / 2) / radius) * 350;
}

// inColor: as what tells layers apart, where there are several and this one has no facets to show its colour.
function edgeSegments(layer, length, inColor) {
  const { ends, mark, flags } = layer.edges;
  const { xyz } = layer.vertices;
  const at = (vertex) => xyz.subarray(3 * vertex, 3 * vertex + 3);
  const usual = Math.min(1.7, Math.max(0.7, length * 0.08));
  return Array.from(mark, (m, e) => {
    const own = originOf(flags[e]) === ORIGIN_OWN;
    return {
      start: at(ends[2 * e]),
      end: at(ends[2 * e + 1]),
      rgb: !own ? GREY : inColor && m ? rgbOf(layer.color) : lineColor(m),
      width: isolated(flags[e]) && own ? 3.2 : own ? usual : Math.min(usual, 1.1),
    };
  });
}

function vertexDots(layer, length) {
  const { xyz, mark, flags } = layer.vertices;
  const usual = Math.min(8, Math.max(2, length * 0.24));
  const dots = [];
  mark.forEach((m, v) => {
    if (originOf(flags[v]) !== ORIGIN_OWN) return;
    dots.push({ at: xyz.subarray(3 * v, 3 * v + 3), ...dotColors(m), diameter: isolated(flags[v]) ? 11 : usual });
  });
  return dots;
}

function boxSegments([low, high]) {
  const corner = (i) => [i & 1 ? high[0] : low[0], i & 2 ? high[1] : low[1], i & 4 ? high[2] : low[2]];
  const segments = [];
  for (let i = 0; i < 8; ++i) {
    for (const bit of [1, 2, 4]) {
      if (i & bit) continue;
      // Dashes, so that it is not taken for a part of the set.
      const [a, b] = [corner(i), corner(i | bit)];
      for (let k = 0; k < 24; k += 2) {
        const between = (t) => a.map((x, j) => x + (b[j] - x) * t);
        segments.push({ start: between(k / 24), end: between((k + 1) / 24), rgb: GREY, width: 1.2 });
      }
    }
  }
  return segments;
}

function photoMesh(photo, onLoad) {
  const [a, b, c, d] = photo.corners;
  const geometry = new THREE.BufferGeometry();
  geometry.setAttribute("position", new THREE.BufferAttribute(new Float32Array([...a, ...b, ...c, ...d]), 3));
  geometry.setAttribute("uv", new THREE.BufferAttribute(new Float32Array([0, 1, 1, 1, 1, 0, 0, 0]), 2));
  geometry.setIndex([0, 3, 1, 1, 3, 2]);
  const material = new THREE.MeshBasicMaterial({ side: THREE.DoubleSide });
  material.map = new THREE.TextureLoader().load(photo.url, onLoad);
  return new THREE.Mesh(geometry, material);
}

function extraSegments(layer) {
  const segments = [];
  for (const line of layer.lines) {
    const point = (i) => line.xyz.subarray(3 * i, 3 * i + 3);
    for (let i = 0; 3 * (i + 1) < line.xyz.length; ++i) {
      segments.push({ start: point(i), end: point(i + 1), rgb: rgbOf(line.color), width: 2.2 });
    }
  }
  for (const photo of layer.photos) {
    if (!photo.eye) continue;
    for (const corner of photo.corners) segments.push({ start: photo.eye, end: corner, rgb: GREY, width: 1 });
  }
  return segments;
}

// Drawn after transparent facets, which would pale it; what is opaque still hides it.
function shineThrough(mesh) {
  mesh.material.transparent = true;
  mesh.renderOrder = 1;
  return mesh;
}

// Its numbers are shown as they are, as those of all facets.
function surfaceImage(url, onLoad) {
  const image = new THREE.TextureLoader().load(url, onLoad);
  image.generateMipmaps = false; // charts would mix
  image.minFilter = THREE.LinearFilter;
  return image;
}

// Views by layer: the pieces of one are together.
export function byLayer(views) {
  const layers = new Map();
  for (const view of views) {
    const key = view.layer.piece ? view.layer.name : view;
    if (layers.has(key)) layers.get(key).push(view);
    else layers.set(key, [view]);
  }
  return [...layers.values()];
}

export class LayerView {
  // radius: of the page, in which the layer is seen; alone: it is the only one.
  constructor(layer, shared, radius, alone, onLoad) {
    const length = meanLength(layer, radius);
    const thin = layer.facets.mark.length === 0;
    // Lines and dots would cover the colours of a surface.
    this.dense = !thin && (length < DENSE || layer.surface !== undefined);
    this.layer = layer;
    this.opacity = { value: layer.opacity };
    this.group = new THREE.Group();
    const image = layer.surface?.url ? surfaceImage(layer.surface.url, onLoad) : null;
    this.facets = new THREE.Mesh(
      facetGeometry(layer),
      facetMaterial(shared, this.opacity, layer.surface !== undefined, image),
    );
    this.facets.frustumCulled = false;
    this.whole = new THREE.Group(); // what CoarseView draws in few triangles
    const finish = (mesh) => {
      mesh.matrixAutoUpdate = false;
      this.whole.add(thin ? shineThrough(mesh) : mesh);
      return mesh;
    };
    this.makeEdges = () => finish(lineMesh(edgeSegments(layer, length, thin && !alone), shared));
    this.makeVertices = () => finish(dotMesh(vertexDots(layer, length), shared));
    this.shown = { edges: false, vertices: false };
    this.extras = new THREE.Group();
    const segments = extraSegments(layer);
    if (layer.box) segments.push(...boxSegments(layer.box));
    if (segments.length > 0) this.extras.add(shineThrough(lineMesh(segments, shared)));
    for (const photo of layer.photos) this.extras.add(photoMesh(photo, onLoad));
    this.whole.add(this.facets);
    this.group.add(this.whole, this.extras);
    // It moves as a whole, and seldom: by #moved.
    this.group.traverse((object) => (object.matrixAutoUpdate = false));
    this.group.visible = layer.visible;
    this.setOpacity(layer.opacity);
  }

  // Frees what the graphics card has of it.
  dispose() {
    this.group.traverse((object) => {
      object.geometry?.dispose();
      object.material?.map?.dispose();
      object.material?.dispose();
    });
  }

  setOpacity(value) {
    this.opacity.value = value;
    const { material } = this.facets;
    const transparent = value < 0.995;
    if (material.transparent !== transparent) material.needsUpdate = true;
    material.transparent = transparent;
    material.depthWrite = !transparent;
    this.facets.visible = this.wanted !== false && value > 0.005;
  }

  show(facets, edges, vertices) {
    this.wanted = facets;
    this.facets.visible = facets && this.opacity.value > 0.005;
    this.shown = { edges, vertices };
    // Made when they are seen first: of large meshes they seldom are.
    if (edges) this.edges ??= this.makeEdges();
    if (vertices) this.vertices ??= this.makeVertices();
    if (this.edges) this.edges.visible = edges;
    if (this.vertices) this.vertices.visible = vertices;
  }

  // Puts it where its coordinates begin.
  place() {
    const { x, y, z } = this.group.position;
    const [toX, toY, toZ] = this.layer.offset ?? [x, y, z];
    if (this.placed && toX === x && toY === y && toZ === z) return;
    this.placed = true;
    this.group.position.set(toX, toY, toZ);
    this.#moved();
  }

  // Moves it by a vector from where the page has it.
  moveBy(vector) {
    this.group.position.set(...vector);
    this.#moved();
  }

  #moved() {
    this.group.updateMatrix();
    this.group.matrixWorldNeedsUpdate = true;
  }

  // Moves the layer to where its motion is at a time.
  setTime(time) {
    const { motion } = this.layer;
    if (!motion) return;
    const { times, offsets, turns, pivot } = motion;
    let i = 0;
    while (i + 2 < times.length && times[i + 1] < time) ++i;
    const j = Math.min(i + 1, times.length - 1);
    const span = times[j] - times[i];
    const t = span > 0 ? Math.min(1, Math.max(0, (time - times[i]) / span)) : 0;
    this.group.position.set(...offsets[i].map((x, k) => x + (offsets[j][k] - x) * t));
    if (turns) {
      const quaternion = ([w, x, y, z]) => new THREE.Quaternion(x, y, z, w);
      this.group.quaternion.slerpQuaternions(quaternion(turns[i]), quaternion(turns[j]), t);
      // About the pivot rather than the origin.
      const about = new THREE.Vector3(...pivot);
      this.group.position.add(about).sub(about.clone().applyQuaternion(this.group.quaternion));
    }
    this.#moved();
  }

  // From the layer's coordinates to the page's.
  matrix() {
    return this.group.matrix;
  }
}
