// SPDX-License-Identifier: Apache-2.0
//
// The sphere map of a vertex: its items, and which sface holds a direction.
import { add3, angleAbout, arcPoints, cross3, dot3, normalTo, scale3, unit3 } from "./vectors.js";

// The sphere map of vertex `vertex` (of the scene) as objects.
export function sphereMap(layer, vertex) {
  const { begin, directions, dots, normals, arcs, circleNormals, circles, regions } = layer.spheres;
  const range = (k, make) => {
    const list = [];
    for (let i = begin[4 * vertex + k]; i < begin[4 * vertex + 4 + k]; ++i) list.push(make(i));
    return list;
  };
  const unit = (array, i) => unit3(Array.from(array.subarray(3 * i, 3 * i + 3)));
  const map = {
    dots: range(0, (i) => ({ direction: unit(directions, i), mark: dots[2 * i], halfedge: dots[2 * i + 1] })),
    arcs: range(1, (i) => {
      const [source, target, mark, facet, left, right] = arcs.subarray(6 * i, 6 * i + 6);
      return { normal: unit(normals, i), source, target, mark, facet, left, right };
    }),
    circles: range(2, (i) => {
      const [mark, facet, left, right] = circles.subarray(4 * i, 4 * i + 4);
      return { normal: unit(circleNormals, i), mark, facet, left, right };
    }),
    regions: range(3, (i) => ({ mark: regions[2 * i], volume: regions[2 * i + 1] })),
  };
  for (const arc of map.arcs) {
    // Directions are rounded: what is drawn starts at the svertex and stays on the circle.
    const start = map.dots[arc.source].direction;
    arc.start = unit3(add3(start, scale3(arc.normal, -dot3(start, arc.normal))));
    arc.angle = arc.source === arc.target ? 2 * Math.PI : angleAbout(arc.normal, arc.start, map.dots[arc.target].direction);
    arc.points = arcPoints(arc.start, arc.normal, arc.angle);
  }
  for (const circle of map.circles) {
    circle.start = normalTo(circle.normal);
    circle.angle = 2 * Math.PI;
    circle.points = arcPoints(circle.start, circle.normal, circle.angle);
  }
  return map;
}

// The region (sface) that holds a direction. From there a great circle leads to the middle of some arc; the side of the
// first arc or circle that it meets tells. Several arcs are asked, since rounding may mislead one near a corner.
export function regionAt(map, direction) {
  const curves = [...map.arcs, ...map.circles];
  if (curves.length === 0) return 0;
  const votes = new Map();
  const step = Math.max(1, Math.floor(curves.length / 3));
  for (let k = 0; k < curves.length; k += step) {
    const middle = curves[k].points[Math.floor(curves[k].points.length / 2)];
    const region = firstSide(curves, direction, middle);
    if (region === null) continue;
    const count = (votes.get(region) ?? 0) + 1;
    if (count > 1) return region;
    votes.set(region, count);
  }
  const [first] = votes.keys();
  return first ?? 0;
}

// The region on this side of the first curve between two directions; null if there is none.
function firstSide(curves, from, to) {
  const axis = unit3(cross3(from, to));
  if (!(dot3(axis, axis) > 0.5)) return null;
  const reach = angleAbout(axis, from, to) + 1e-4;
  let best = reach;
  let region = null;
  for (const curve of curves) {
    const side = dot3(curve.normal, from);
    const crossing = cross3(curve.normal, axis);
    if (dot3(crossing, crossing) < 1e-12) continue;
    // Of the two crossings the one ahead, within a half turn.
    let point = unit3(crossing);
    let angle = angleAbout(axis, from, point);
    if (angle > Math.PI) {
      point = scale3(point, -1);
      angle -= Math.PI;
    }
    if (angle >= best) continue;
    if (curve.angle < 2 * Math.PI - 1e-9 && angleAbout(curve.normal, curve.start, point) > curve.angle) continue;
    best = angle;
    region = side > 0 ? curve.left : curve.right;
  }
  return region;
}
