// SPDX-License-Identifier: Apache-2.0
//
// The viewer: one scene, its controls, and what is known about the item that was clicked. A page shows one scene; the
// studio shows one after the other.
import * as THREE from "three";
import { CameraControl } from "./camera_control.js";
import { CoarseView, MOST_TRIANGLES, triangleCount } from "./draw/coarse_view.js";
import { FramePacer } from "./draw/frame_pacer.js";
import { itemText, markBadge, sphereItemText } from "./item_text.js";
import { LayerView, dotMesh, lineMesh } from "./draw/layer_view.js";
import { sharedUniforms } from "./draw/materials.js";
import { byId, makeLayerRows, makeLegend } from "./panel.js";
import { Picker } from "./picking.js";
import { originOf, ORIGIN_OWN } from "./scene_data.js";
import { Section } from "./draw/section.js";
import { SmoothFrame } from "./draw/smooth_frame.js";
import { SphereView } from "./sphere_view.js";

THREE.ColorManagement.enabled = false;
const HIGHLIGHT = [230, 20, 90];
const START_DIRECTION = new THREE.Vector3(0.55, -0.75, 0.42);
const UP = new THREE.Vector3(0, 0, 1);
const PLAY_SECONDS = 10;

export class Viewer {
  constructor(page) {
    this.canvas = byId("view");
    this.renderer = new THREE.WebGLRenderer({ canvas: this.canvas, antialias: false, stencil: true });
    // Colours are numbers of the screen throughout, in the canvas and beside it.
    this.renderer.outputColorSpace = THREE.LinearSRGBColorSpace;
    this.smooth = new SmoothFrame(this.renderer);
    this.sharpness = 1; // the share of the pixels of a side that is drawn
    this.pacer = new FramePacer(this.renderer.getContext(), {
      draw: (share, coarse) => this.#render(share, coarse),
      isLarge: () => this.views.reduce((sum, view) => sum + triangleCount(view), 0) > MOST_TRIANGLES,
    });
    this.coarse = new CoarseView();
    this.#followColorScheme();
    this.camera = new THREE.PerspectiveCamera(32, 1, 0.1, 100);
    this.shared = sharedUniforms();
    this.scene = new THREE.Scene();
    this.views = [];
    // Views that are no longer seen, until others are drawn: shaders that nothing uses are forgotten, and to compile them again
    // for each scene takes ten times as long as to draw it.
    this.retired = [];
    this.selected = null;
    this.onSelect = () => {}; // told of every item that is selected, and of null
    this.details = null; // async (item): {exact, spheres} of its layer, of which only the item's need be there
    this.control = new CameraControl(this.canvas, this.camera, {
      onChange: () => this.requestDraw(),
      onTap: (x, y) => this.select(this.picker.pick(x, y)),
    });
    this.#wireControls();
    this.show(page);
    new ResizeObserver(() => this.resize()).observe(this.canvas);
    this.resize();
    this.reset();
  }

  // Shows a scene in place of the one before, of which layers that are the same objects stay drawn. The eye stays where it is in space; layers of the same name stay switched on
  // or off, and as transparent, as they are.
  show(page) {
    const before = new Map(this.views.map((view) => [view.layer.name, view]));
    const drawn = new Map(this.views.map((view) => [view.layer, view]));
    this.select(null);
    if (this.section) this.section.dispose();
    const stays = new Set(page.layers);
    for (const view of this.views) {
      if (stays.has(view.layer)) continue;
      this.scene.remove(view.group);
      this.retired.push(view);
    }
    if (this.page) this.control.shift(this.page.center.map((x, i) => x - page.center[i]));
    this.page = page;
    const [low, high] = page.bounds ?? [[-1, -1, -1], [1, 1, 1]];
    this.radius = Math.hypot(...high.map((x, i) => x - low[i])) / 2 || 1;
    const alone = page.layers.length === 1;
    this.views = page.layers.map((layer) => {
      const same = before.get(layer.name);
      if (same) Object.assign(layer, { visible: same.group.visible, opacity: same.opacity.value });
      const view = drawn.get(layer) ?? new LayerView(layer, this.shared, this.radius, alone, () => this.requestDraw());
      if (!drawn.has(layer)) this.scene.add(view.group);
      view.place();
      return view;
    });
    this.section = new Section(this.views, this.shared, this.radius, this.section);
    this.section.addTo(this.scene);
    this.picker = new Picker(this.views, this.section, this.camera, this.canvas);
    this.coarse.dispose();
    this.coarseIsOld = true;
    this.#showControls();
    this.requestDraw();
  }

  // What is visible at first fills the view; what is not may be much larger.
  reset() {
    const [low, high] = this.page.focus ?? this.page.bounds ?? [[-1, -1, -1], [1, 1, 1]];
    this.control.target.set(...low.map((x, i) => (x + high[i]) / 2));
    const radius = Math.hypot(...high.map((x, i) => x - low[i])) / 2 || this.radius;
    this.control.frame(START_DIRECTION, UP, radius * 1.08);
  }

  // Lines are dark and orange on either ground, so the dark one is a middle grey.
  #followColorScheme() {
    const dark = window.matchMedia("(prefers-color-scheme: dark)");
    const apply = () => {
      this.renderer.setClearColor(dark.matches ? 0x8b96a2 : 0xf4f6f8);
      if (this.control) this.requestDraw();
    };
    dark.addEventListener("change", apply);
    apply();
  }

  resize() {
    const { clientWidth, clientHeight } = this.canvas;
    if (!clientWidth || !clientHeight) return;
    this.camera.aspect = clientWidth / clientHeight;
    this.renderer.setSize(clientWidth, clientHeight, false);
    this.#sharpen(this.sharpness);
    this.requestDraw();
  }

  #sharpen(share) {
    this.sharpness = share;
    const ratio = window.devicePixelRatio * share;
    this.renderer.setPixelRatio(ratio);
    this.renderer.getDrawingBufferSize(this.shared.size.value);
    this.shared.ratio.value = ratio;
  }

  requestDraw() {
    this.pacer.request();
  }

  // Now, in all pixels.
  draw() {
    this.pacer.drawn();
    this.#render(1, false);
  }

  // In a share of the pixels of a side; coarse: large layers in few triangles. A section's caps need closed boundaries.
  #render(share, coarse) {
    if (share !== this.sharpness) this.#sharpen(share);
    const distance = this.camera.position.length();
    this.camera.near = Math.max(distance - 1.5 * this.radius, distance * 0.01, this.radius * 0.002);
    this.camera.far = distance + 2 * this.radius;
    this.camera.updateProjectionMatrix();
    this.camera.updateMatrixWorld();
    this.section.update();
    const render = () => this.renderer.render(this.scene, this.camera);
    if (coarse && !this.section.on) this.#coarseView().draw(this.scene, render);
    else if (share === 1) this.smooth.draw(render);
    else render();
    for (const view of this.retired.splice(0)) view.dispose();
  }

  #coarseView() {
    if (this.coarseIsOld) this.coarse.show(this.views, this.radius, this.page.center);
    this.coarseIsOld = false;
    return this.coarse;
  }

  // For what is dragged from a pixel, so deep: the plane of the two coordinates that the eye looks across. at(x, y) is the
  // point of a pixel in it, null where there is none; axis is the coordinate that stays; pixel is how far a pixel is.
  dragPlane(x, y, depth) {
    const { origin, direction } = this.picker.ray(x, y);
    const look = this.camera.getWorldDirection(new THREE.Vector3()).toArray().map(Math.abs);
    const axis = look.indexOf(Math.max(...look));
    const level = origin[axis] + depth * direction[axis];
    return {
      axis,
      pixel: (2 * depth * Math.tan((this.camera.fov * Math.PI) / 360)) / this.canvas.clientHeight,
      at: (toX, toY) => {
        const ray = this.picker.ray(toX, toY);
        const t = (level - ray.origin[axis]) / ray.direction[axis];
        return t > 0 && Number.isFinite(t) ? ray.origin.map((o, i) => o + t * ray.direction[i]) : null;
      },
    };
  }

  // Shows what is known about an item; null for none.
  select(item) {
    this.selected = item;
    this.onSelect(item);
    byId("item").hidden = !item;
    if (this.highlight) this.scene.remove(this.highlight);
    this.highlight = null;
    if (item) {
      this.#showHighlight(item);
      this.#showItem(item);
      this.#findDetails(item);
    }
    this.requestDraw();
  }

  #showItem(item) {
    byId("item-text").innerHTML = itemText(this.page, item);
    this.#showSphere(item);
  }

  // Of scenes that came without: asked for where there is somebody to ask.
  async #findDetails(item) {
    if (!this.details || this.page.layers[item.layer].exact) return;
    const details = await this.details(item);
    if (!details || this.selected !== item) return;
    item.details = details;
    this.#showItem(item);
  }

  #showHighlight({ kind, layer, item }) {
    const view = this.views[layer];
    const { xyz } = view.layer.vertices;
    const at = (vertex) => xyz.subarray(3 * vertex, 3 * vertex + 3);
    const segment = (a, b) => ({ start: at(a), end: at(b), rgb: HIGHLIGHT, width: 4 });
    if (kind === "vertex") {
      this.highlight = dotMesh([{ at: at(item), fill: HIGHLIGHT, rim: [255, 255, 255], diameter: 15 }], this.shared);
    } else if (kind === "edge") {
      const { ends } = view.layer.edges;
      this.highlight = lineMesh([segment(ends[2 * item], ends[2 * item + 1])], this.shared);
    } else {
      this.highlight = lineMesh(this.#facetBoundary(view.layer, item).map(([a, b]) => segment(a, b)), this.shared);
    }
    this.highlight.material.depthTest = false; // seen through everything
    this.highlight.renderOrder = 1000;
    this.highlight.position.copy(view.group.position);
    this.highlight.quaternion.copy(view.group.quaternion);
    this.scene.add(this.highlight);
  }

  // Sides that only one triangle of the facet has.
  #facetBoundary(layer, facet) {
    const { begin, corners } = layer.facets;
    const sides = new Map();
    for (let i = 3 * begin[facet]; i < 3 * begin[facet + 1]; ++i) {
      const next = i % 3 === 2 ? i - 2 : i + 1;
      const pair = [corners[i], corners[next]];
      const key = pair.slice().sort((a, b) => a - b).join();
      if (!sides.delete(key)) sides.set(key, pair);
    }
    return [...sides.values()];
  }

  #showSphere({ kind, layer, item, details }) {
    const { vertices } = this.page.layers[layer];
    const spheres = details?.spheres ?? this.page.layers[layer].spheres;
    const any = kind === "vertex" && spheres && spheres.begin[4 * item + 7] > spheres.begin[4 * item + 3];
    byId("sphere").hidden = !any;
    if (!any) return;
    this.sphere ??= new SphereView(byId("sphere-view"), (pick) => {
      byId("sphere-text").innerHTML = sphereItemText(this.sphere.map, pick) || this.sphereHint;
    });
    this.sphere.show({ ...this.page.layers[layer], spheres }, item, this.camera, this.control.target);
    this.sphereHint = `Centre ${markBadge(vertices.mark[item])} Turn it; click an item of it.`;
    byId("sphere-text").innerHTML = this.sphereHint;
  }

  // The next or previous vertex of the visible layers, for those without a pointer.
  walk(step) {
    const all = this.views.flatMap((view, layer) => (view.group.visible
      ? Array.from(view.layer.vertices.flags, (flags, item) => ({ flags, item })).filter(({ flags }) => originOf(flags) === ORIGIN_OWN)
        .map(({ item }) => ({ kind: "vertex", layer, item })) : []));
    if (all.length === 0) return;
    const { layer, item, kind } = this.selected ?? {};
    const now = kind === "vertex" ? all.findIndex((one) => one.layer === layer && one.item === item) : -1;
    this.select(all[now < 0 ? (step > 0 ? 0 : all.length - 1) : (now + step + all.length) % all.length]);
  }

  #showBoxes() {
    return ["facets", "edges", "vertices"].map((name) => byId(`show-${name}`));
  }

  #applyBoxes() {
    const shown = this.#showBoxes().map((box) => box.checked);
    for (const view of this.views) view.show(...shown);
    this.requestDraw();
  }

  // Once.
  #wireControls() {
    for (const box of this.#showBoxes()) box.addEventListener("change", () => this.#applyBoxes());
    byId("close").addEventListener("click", () => this.select(null));
    byId("fold").addEventListener("click", () => byId("panel").classList.toggle("folded"));
    this.#wireSection();
    this.#wireTime();
    window.addEventListener("keydown", (event) => this.#key(event));
    if (window.innerWidth <= 640) byId("panel").classList.add("folded");
  }

  // For each scene.
  #showControls() {
    document.querySelector("#panel h1").textContent = this.page.title;
    makeLayerRows(this.views, () => this.requestDraw());
    makeLegend(this.page);
    // Of a dense mesh the facets are seen first.
    const dense = this.views.some((view) => view.dense && view.layer.visible);
    const [, edges, vertices] = this.#showBoxes();
    if (dense && !this.wasDense) edges.checked = vertices.checked = false;
    if (!dense && this.wasDense) edges.checked = vertices.checked = true;
    this.wasDense = dense;
    this.#applyBoxes();
    this.#showTime();
  }

  #wireSection() {
    const change = () => {
      const { section } = this;
      section.on = byId("section-on").checked;
      section.offset = Number(byId("section-offset").value);
      this.requestDraw();
    };
    byId("section-on").addEventListener("change", change);
    byId("section-offset").addEventListener("input", () => {
      byId("section-on").checked = true;
      change();
    });
    for (const button of document.querySelectorAll("#section-axes button")) {
      button.addEventListener("click", () => {
        const { section } = this;
        const { axis } = button.dataset;
        if (axis === "flip") {
          section.normal.negate();
          byId("section-offset").value = -section.offset;
        } else if (axis === "view") {
          section.normal.copy(this.camera.position).sub(this.control.target).normalize();
        } else {
          section.normal.set(...["x", "y", "z"].map((name) => Number(name === axis)));
          // The cut faces the eye.
          if (section.normal.dot(this.camera.position) < 0) section.normal.negate();
        }
        byId("section-on").checked = true;
        change();
      });
    }
  }

  #setTime(share) {
    const [first, last] = this.times;
    byId("time-slider").value = share;
    const time = first + share * (last - first);
    byId("time-text").value = `${time.toFixed(2)} s`;
    for (const view of this.views) view.setTime(time);
    this.requestDraw();
  }

  #wireTime() {
    const slider = byId("time-slider");
    slider.addEventListener("input", () => this.#setTime(Number(slider.value)));
    let playing = 0;
    byId("play").addEventListener("click", () => {
      const me = ++playing;
      if (byId("play").classList.toggle("chosen")) {
        if (Number(slider.value) >= 1) slider.value = 0;
        let before = performance.now();
        const step = (now) => {
          if (playing !== me || !this.times) return;
          const share = Math.min(1, Number(slider.value) + (now - before) / 1000 / PLAY_SECONDS);
          before = now;
          this.#setTime(share);
          if (share < 1) requestAnimationFrame(step);
          else byId("play").classList.remove("chosen");
        };
        requestAnimationFrame(step);
      }
    });
  }

  #showTime() {
    const times = this.page.layers.flatMap((layer) => layer.motion?.times ?? []);
    byId("time").hidden = times.length === 0;
    const share = this.times ? Number(byId("time-slider").value) : 0;
    this.times = times.length === 0 ? null : [Math.min(...times), Math.max(...times)];
    if (this.times) this.#setTime(share);
    else byId("play").classList.remove("chosen");
  }

  #key(event) {
    if (event.ctrlKey || event.metaKey || event.altKey) return;
    if (event.target.closest("textarea, select, input:not([type=range]):not([type=checkbox])")) return; // who types
    const click = (id) => byId(id).click();
    const nudge = (by) => {
      byId("section-offset").value = Number(byId("section-offset").value) + by;
      byId("section-offset").dispatchEvent(new Event("input"));
    };
    const actions = {
      f: () => click("show-facets"), e: () => click("show-edges"), v: () => click("show-vertices"),
      s: () => click("section-on"), "[": () => nudge(-0.02), "]": () => nudge(0.02),
      n: () => this.walk(1), p: () => this.walk(-1), r: () => this.reset(), Escape: () => this.select(null),
      " ": () => event.target.tagName !== "BUTTON" && event.target.tagName !== "INPUT" && !byId("time").hidden && click("play"),
    };
    actions[event.key]?.();
  }
}
