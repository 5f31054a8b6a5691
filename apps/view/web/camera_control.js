// SPDX-License-Identifier: Apache-2.0
//
// Turns, moves and zooms a camera about a target: mouse, touch (one finger turns, two move and zoom) and keys. Turning is
// free of poles: about the screen's own axes.
import * as THREE from "three";

const TAP_DISTANCE = 6; // pixels that a pointer may move between press and release to count as a tap
const KEY_ANGLE = Math.PI / 24;

export class CameraControl {
  // onChange() after every move of the camera, onTap(x, y) in pixels of the canvas. `canMove` allows to leave the target.
  constructor(canvas, camera, { onChange, onTap, canMove = true }) {
    Object.assign(this, { canvas, camera, onChange, onTap, canMove });
    this.target = new THREE.Vector3();
    this.pointers = new Map();
    this.travel = 0;
    this.grab = () => null; // (x, y) to what is held there: {drag(x, y), drop()}; null turns the camera
    this.held = null;
    canvas.addEventListener("pointerdown", (event) => this.#press(event));
    canvas.addEventListener("pointermove", (event) => this.#drag(event));
    canvas.addEventListener("pointerup", (event) => this.#release(event));
    canvas.addEventListener("pointercancel", (event) => {
      this.pointers.delete(event.pointerId);
      this.#drop();
    });
    canvas.addEventListener("contextmenu", (event) => event.preventDefault());
    canvas.addEventListener("wheel", (event) => {
      event.preventDefault();
      this.zoom(Math.exp(event.deltaY * (event.deltaMode ? 0.03 : 0.001)));
    }, { passive: false });
    canvas.addEventListener("keydown", (event) => this.#key(event));
  }

  // Looks at the target from a direction, far enough to see a ball of the given radius.
  frame(direction, up, radius) {
    const half = (this.camera.fov * Math.PI) / 360;
    const narrow = Math.min(half, Math.atan(Math.tan(half) * this.camera.aspect));
    const distance = radius / Math.sin(narrow);
    this.camera.up.copy(up);
    this.camera.position.copy(this.target).addScaledVector(direction.clone().normalize(), distance);
    this.camera.lookAt(this.target);
    this.onChange();
  }

  // Moves target and eye.
  shift(by) {
    const vector = new THREE.Vector3(...by);
    this.target.add(vector);
    this.camera.position.add(vector);
    this.camera.updateMatrixWorld();
    this.onChange();
  }

  // Angles in radians about the screen's vertical and horizontal axes.
  turn(right, down) {
    const { camera } = this;
    const offset = camera.position.clone().sub(this.target);
    const side = new THREE.Vector3().setFromMatrixColumn(camera.matrix, 0);
    const up = new THREE.Vector3().setFromMatrixColumn(camera.matrix, 1);
    const rotation = new THREE.Quaternion().setFromAxisAngle(up, -right)
      .multiply(new THREE.Quaternion().setFromAxisAngle(side, -down));
    camera.position.copy(this.target).add(offset.applyQuaternion(rotation));
    camera.up.copy(up.applyQuaternion(rotation));
    camera.lookAt(this.target);
    camera.updateMatrix();
    this.onChange();
  }

  zoom(factor) {
    const offset = this.camera.position.clone().sub(this.target);
    this.camera.position.copy(this.target).addScaledVector(offset, factor);
    this.onChange();
  }

  // In pixels.
  move(right, down) {
    if (!this.canMove) return;
    const { camera } = this;
    const distance = camera.position.distanceTo(this.target);
    const pixel = (2 * distance * Math.tan((camera.fov * Math.PI) / 360)) / this.canvas.clientHeight;
    const shift = new THREE.Vector3().setFromMatrixColumn(camera.matrix, 0).multiplyScalar(-right * pixel)
      .addScaledVector(new THREE.Vector3().setFromMatrixColumn(camera.matrix, 1), down * pixel);
    camera.position.add(shift);
    this.target.add(shift);
    this.onChange();
  }

  #press(event) {
    this.canvas.focus({ preventScroll: true });
    this.canvas.setPointerCapture(event.pointerId);
    this.pointers.set(event.pointerId, { x: event.clientX, y: event.clientY });
    if (this.pointers.size === 1) this.travel = 0;
    else this.travel = Infinity;
    this.#drop();
    if (this.pointers.size === 1 && event.button === 0 && !event.shiftKey) this.held = this.grab(...this.#place(event));
  }

  #place(event) {
    const box = this.canvas.getBoundingClientRect();
    return [event.clientX - box.left, event.clientY - box.top];
  }

  #drop() {
    const { held } = this;
    this.held = null;
    held?.drop();
  }

  #drag(event) {
    const last = this.pointers.get(event.pointerId);
    if (!last) return;
    const dx = event.clientX - last.x;
    const dy = event.clientY - last.y;
    this.travel += Math.abs(dx) + Math.abs(dy);
    if (this.pointers.size === 2) {
      const [other] = [...this.pointers].filter(([id]) => id !== event.pointerId).map(([, p]) => p);
      const before = Math.hypot(last.x - other.x, last.y - other.y);
      const after = Math.hypot(event.clientX - other.x, event.clientY - other.y);
      if (after > 0) this.zoom(before / after);
      this.move(dx / 2, dy / 2);
    } else if (this.held && this.travel > TAP_DISTANCE) {
      this.held.drag(...this.#place(event));
    } else if (this.travel > TAP_DISTANCE) {
      if (event.shiftKey || (event.buttons & 6) !== 0) this.move(dx, dy);
      else this.turn((dx / this.canvas.clientHeight) * 4, (dy / this.canvas.clientHeight) * 4);
    }
    last.x = event.clientX;
    last.y = event.clientY;
  }

  #release(event) {
    if (!this.pointers.delete(event.pointerId)) return;
    this.#drop();
    if (this.pointers.size > 0 || this.travel > TAP_DISTANCE) return;
    this.onTap(...this.#place(event));
  }

  #key(event) {
    const steps = { ArrowLeft: [1, 0], ArrowRight: [-1, 0], ArrowUp: [0, 1], ArrowDown: [0, -1] }[event.key];
    if (steps && event.shiftKey) this.move(steps[0] * 30, steps[1] * 30);
    else if (steps) this.turn(steps[0] * KEY_ANGLE, steps[1] * KEY_ANGLE);
    else if (event.key === "+" || event.key === "=") this.zoom(0.9);
    else if (event.key === "-") this.zoom(1 / 0.9);
    else return;
    event.preventDefault();
  }
}
