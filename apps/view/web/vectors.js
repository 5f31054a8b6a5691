// SPDX-License-Identifier: Apache-2.0
//
// Vectors as arrays of three numbers, for what is computed without the graphics card.

export const add3 = (a, b) => [a[0] + b[0], a[1] + b[1], a[2] + b[2]];
export const sub3 = (a, b) => [a[0] - b[0], a[1] - b[1], a[2] - b[2]];
export const scale3 = (a, s) => [a[0] * s, a[1] * s, a[2] * s];
export const dot3 = (a, b) => a[0] * b[0] + a[1] * b[1] + a[2] * b[2];
export const cross3 = (a, b) => [a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]];
export const length3 = (a) => Math.sqrt(dot3(a, a));
export const unit3 = (a) => scale3(a, 1 / (length3(a) || 1));

// Some unit vector at right angles to a.
export function normalTo(a) {
  const axis = Math.abs(a[0]) < 0.6 ? [1, 0, 0] : [0, 1, 0];
  return unit3(cross3(a, axis));
}

// Points on the arc from a (a unit vector) by `angle` counterclockwise about n (a unit vector at right angles to a).
export function arcPoints(a, n, angle) {
  const b = cross3(n, a);
  const steps = Math.max(2, Math.ceil(angle / 0.06));
  const points = [];
  for (let i = 0; i <= steps; ++i) {
    const t = (angle * i) / steps;
    points.push(add3(scale3(a, Math.cos(t)), scale3(b, Math.sin(t))));
  }
  return points;
}

// The angle from a to b counterclockwise about n, in (0, 2 pi].
export function angleAbout(n, a, b) {
  const angle = Math.atan2(dot3(n, cross3(a, b)), dot3(a, b));
  return angle > 1e-7 ? angle : angle + 2 * Math.PI;
}
