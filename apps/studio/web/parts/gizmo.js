// SPDX-License-Identifier: Apache-2.0
//
// Handles in the view that move, turn and scale something: arrows along the axes, rings about them, a dot between them.
import * as THREE from "three";
import { decimalNear } from "../exact.js";
import { dotMesh, lineMesh } from "../../../view/web/draw/layer_view.js";

const AXIS_NAMES = ["x", "y", "z"];
const AXIS_COLORS = [[214, 48, 49], [32, 150, 70], [40, 90, 220]];
const SCALE_COLOR = [250, 250, 250];
const RING_STEPS = 48;
const RING_SIZE = 0.75; // of the arrows
const HANDLE_REACH = 12; // pixels

export class Gizmo {
  constructor(viewer) {
    this.viewer = viewer;
    this.box = null;
    this.group = null;
  }

  // Around a box of doubles, [low, high]; null hides it.
  show(box) {
    this.hide();
    this.box = box;
    if (!box) return;
    const { viewer } = this;
    this.center = box[0].map((x, i) => (x + box[1][i]) / 2);
    const radius = Math.hypot(...box[1].map((x, i) => x - box[0][i])) / 2;
    this.length = Math.max(1.2 * radius, 0.15 * viewer.radius);
    const { length } = this;
    const at = (axis, along) => [0, 1, 2].map((i) => (i === axis ? along : 0));
    this.handles = AXIS_NAMES.flatMap((name, axis) => {
      const [u, v] = [(axis + 1) % 3, (axis + 2) % 3];
      const ring = Array.from({ length: RING_STEPS + 1 }, (_, k) => {
        const angle = (2 * Math.PI * k) / RING_STEPS;
        const point = [0, 0, 0];
        point[u] = RING_SIZE * length * Math.cos(angle);
        point[v] = RING_SIZE * length * Math.sin(angle);
        return point;
      });
      return [{ kind: "move", axis, points: [at(axis, length)] }, { kind: "turn", axis, points: ring }];
    });
    const diagonal = [0, 1, 2].map(() => 0.45 * length);
    this.handles.push({ kind: "scale", axis: 0, points: [diagonal] });
    const segments = [];
    const dots = [{ at: diagonal, fill: SCALE_COLOR, rim: [40, 40, 40], diameter: 14 }];
    for (const { kind, axis, points } of this.handles) {
      const rgb = AXIS_COLORS[axis];
      if (kind === "move") {
        segments.push({ start: [0, 0, 0], end: points[0], rgb, width: 3 });
        dots.push({ at: points[0], fill: rgb, rim: rgb, diameter: 14 });
      }
      if (kind === "turn") points.slice(1).forEach((end, k) => segments.push({ start: points[k], end, rgb, width: 1.6 }));
    }
    this.group = new THREE.Group();
    for (const mesh of [lineMesh(segments, viewer.shared), dotMesh(dots, viewer.shared)]) {
      mesh.material.depthTest = false;
      mesh.material.transparent = true; // after all that is opaque
      mesh.renderOrder = 1001;
      this.group.add(mesh);
    }
    viewer.scene.add(this.group);
    this.#place();
  }

  hide() {
    this.box = null;
    if (!this.group) return;
    this.viewer.scene.remove(this.group);
    for (const mesh of this.group.children) {
      mesh.geometry.dispose();
      mesh.material.dispose();
    }
    this.group = null;
    this.viewer.requestDraw();
  }

  // Its coordinates are about the centre of the page, which may be another one with every scene.
  #place() {
    this.group.position.set(...this.center.map((x, i) => x - this.viewer.page.center[i]));
    this.viewer.requestDraw();
  }

  // Pixels of a point that is given from the middle of the handles.
  #pixels(point) {
    const { x, y, z } = this.group.position;
    return this.viewer.picker.project([x + point[0], y + point[1], z + point[2]]);
  }

  // The handle that is nearest to a pixel, arrows and the dot before rings; null if none is near.
  handleAt(x, y) {
    if (!this.group) return null;
    const distance = (points) => Math.min(...points.map((point) => {
      const [px, py] = this.#pixels(point);
      return Math.hypot(px - x, py - y);
    }));
    const near = this.handles.map((handle) => ({ handle, away: distance(handle.points) - (handle.kind === "turn" ? 0 : 4) }))
      .sort((a, b) => a.away - b.away)[0];
    return near.away < HANDLE_REACH ? near.handle : null;
  }

  // How far a handle is dragged from pixel to pixel: {kind, axis: its name, by: a decimal}, a way, degrees or a factor.
  dragged({ kind, axis }, [fromX, fromY], [toX, toY]) {
    const [cx, cy] = this.#pixels([0, 0, 0]);
    const name = AXIS_NAMES[axis];
    if (kind === "move") {
      const [tx, ty] = this.#pixels([0, 1, 2].map((i) => (i === axis ? this.length : 0)));
      const square = Math.max(1, (tx - cx) ** 2 + (ty - cy) ** 2);
      const share = ((toX - fromX) * (tx - cx) + (toY - fromY) * (ty - cy)) / square;
      return { kind, axis: name, by: decimalNear(share * this.length, this.length / Math.sqrt(square)) };
    }
    if (kind === "turn") {
      const angle = Math.atan2(cy - toY, toX - cx) - Math.atan2(cy - fromY, fromX - cx);
      const towards = this.viewer.camera.position.getComponent(axis) > this.group.position.getComponent(axis) ? 1 : -1;
      const degrees = Math.round((((angle * 180) / Math.PI + 540) % 360) - 180);
      return { kind, axis: name, by: String(towards * degrees || 0) };
    }
    const size = (x, y) => Math.max(1, Math.hypot(x - cx, y - cy));
    return { kind, axis: name, by: decimalNear(Math.max(0.05, size(toX, toY) / size(fromX, fromY)), 0.01) };
  }

  // Goes along with what is dragged until the next scene.
  follow({ kind, axis, by }) {
    if (!this.group) return;
    this.#place();
    if (kind === "move") this.group.position.setComponent(AXIS_NAMES.indexOf(axis), this.group.position.getComponent(AXIS_NAMES.indexOf(axis)) + Number(by));
  }
}
