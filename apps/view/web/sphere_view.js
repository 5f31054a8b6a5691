// SPDX-License-Identifier: Apache-2.0
//
// The sphere map of a vertex on a canvas of its own: a ball whose regions are sfaces, with arcs and dots on it.
import * as THREE from "three";
import { CameraControl } from "./camera_control.js";
import { sharedUniforms } from "./draw/materials.js";
import { dotColors, dotMesh, lineColor, lineMesh, rgbOf } from "./draw/layer_view.js";
import { regionAt, sphereMap } from "./sphere_regions.js";
import { dot3, scale3 } from "./vectors.js";

const TEXTURE = [384, 192];
const EMPTY = [236, 240, 244];

function regionTexture(layer, map) {
  const [width, height] = map.arcs.length > 60 ? [192, 96] : TEXTURE;
  const pixels = new Uint8Array(width * height * 4);
  const colors = map.regions.map((region) => {
    if (!region.mark) return EMPTY;
    const volume = layer.volumes.find(({ index }) => index === region.volume);
    return rgbOf(volume?.color ?? layer.color);
  });
  for (let y = 0; y < height; ++y) {
    const latitude = ((y + 0.5) / height - 0.5) * Math.PI;
    for (let x = 0; x < width; ++x) {
      const longitude = ((x + 0.5) / width) * 2 * Math.PI - Math.PI;
      const c = Math.cos(latitude);
      const region = regionAt(map, [c * Math.cos(longitude), c * Math.sin(longitude), Math.sin(latitude)]);
      pixels.set([...(colors[region] ?? EMPTY), 255], 4 * (y * width + x));
    }
  }
  const texture = new THREE.DataTexture(pixels, width, height);
  texture.magFilter = THREE.LinearFilter;
  texture.minFilter = THREE.LinearFilter;
  texture.wrapS = THREE.RepeatWrapping;
  texture.needsUpdate = true;
  return texture;
}

// The texture is read by direction, so that the ball needs no seam.
function ball(texture) {
  const material = new THREE.ShaderMaterial({
    uniforms: { regions: { value: texture } },
    transparent: true, // what lies behind shines through a little
    depthWrite: true,
    vertexShader: `
varying vec3 vDirection;
varying vec3 vNormal;
void main() {
  vDirection = position;
  vNormal = normalMatrix * position;
  gl_Position = projectionMatrix * modelViewMatrix * vec4(position, 1.0);
}`,
    fragmentShader: `
uniform sampler2D regions;
varying vec3 vDirection;
varying vec3 vNormal;
void main() {
  vec3 d = normalize(vDirection);
  vec2 uv = vec2(atan(d.y, d.x) / 6.28318530718 + 0.5, asin(clamp(d.z, -1.0, 1.0)) / 3.14159265359 + 0.5);
  float light = 0.72 + 0.28 * max(dot(normalize(vNormal), normalize(vec3(0.35, 0.65, 0.7))), 0.0);
  gl_FragColor = vec4(textureLod(regions, uv, 0.0).rgb * light, 0.86);
}`,
  });
  const mesh = new THREE.Mesh(new THREE.SphereGeometry(1, 64, 48), material);
  mesh.renderOrder = 1;
  return mesh;
}

function polylineSegments(points, selected, width) {
  const segments = [];
  for (let i = 0; i + 1 < points.length; ++i) {
    segments.push({ start: scale3(points[i], 1.006), end: scale3(points[i + 1], 1.006), rgb: lineColor(selected), width });
  }
  return segments;
}

export class SphereView {
  // onPick({kind, ...}) when an item of the sphere map is tapped.
  constructor(canvas, onPick) {
    Object.assign(this, { canvas, onPick });
    this.renderer = new THREE.WebGLRenderer({ canvas, antialias: true, alpha: true });
    this.camera = new THREE.PerspectiveCamera(30, 1, 0.1, 50);
    this.shared = sharedUniforms();
    this.control = new CameraControl(canvas, this.camera, {
      onChange: () => this.draw(),
      onTap: (x, y) => this.onPick(this.pick(x, y)),
      canMove: false,
    });
  }

  // Shows a vertex as the camera of the main view sees it.
  show(layer, vertex, camera, target) {
    this.map = sphereMap(layer, vertex);
    this.scene = new THREE.Scene();
    this.scene.add(ball(regionTexture(layer, this.map)));
    // Once before the ball, and once after it, where only the front passes the test of depth.
    const addTwice = (make) => [false, true].forEach((after) => {
      const object = make();
      object.material.transparent = after;
      object.renderOrder = after ? 2 : 0;
      this.scene.add(object);
    });
    const segments = [];
    for (const arc of this.map.arcs) segments.push(...polylineSegments(arc.points, arc.mark, 3));
    for (const circle of this.map.circles) segments.push(...polylineSegments(circle.points, circle.mark, 3));
    addTwice(() => lineMesh(segments, this.shared));
    const dots = this.map.dots.map((dot) => ({ at: scale3(dot.direction, 1.012), ...dotColors(dot.mark), diameter: 12 }));
    addTwice(() => dotMesh(dots, this.shared));
    this.control.frame(this.#direction(camera.position.clone().sub(target)), camera.up, 1.15);
    return this.map;
  }

  // From where the main camera is, but turned towards the side where the items are.
  #direction(fromCamera) {
    const towards = new THREE.Vector3();
    for (const { direction } of this.map.dots) towards.add(new THREE.Vector3(...direction));
    const view = fromCamera.normalize();
    if (towards.length() < 0.2) return view;
    return view.addScaledVector(towards.normalize(), 1.4);
  }

  draw() {
    if (!this.scene) return;
    const ratio = window.devicePixelRatio;
    this.renderer.setPixelRatio(ratio);
    this.renderer.setSize(this.canvas.clientWidth || 280, this.canvas.clientHeight || 280, false);
    this.renderer.getDrawingBufferSize(this.shared.size.value);
    this.shared.ratio.value = ratio;
    this.renderer.render(this.scene, this.camera);
  }

  // The item under a pixel: {kind: "svertex" | "sedge" | "sloop" | "sface", item} or null beside the ball.
  pick(x, y) {
    const ndc = [(x / this.canvas.clientWidth) * 2 - 1, 1 - (y / this.canvas.clientHeight) * 2];
    const ray = new THREE.Raycaster();
    ray.setFromCamera(new THREE.Vector2(...ndc), this.camera);
    const hit = ray.ray.intersectSphere(new THREE.Sphere(new THREE.Vector3(), 1), new THREE.Vector3());
    if (!hit) return null;
    const at = hit.toArray();
    const nearest = (items, distance, reach) => {
      const best = items.map((item, i) => [distance(item), i]).sort((a, b) => a[0] - b[0])[0];
      return best && best[0] < reach ? best[1] : -1;
    };
    const dot = nearest(this.map.dots, ({ direction }) => 1 - dot3(direction, at), 0.012);
    if (dot >= 0) return { kind: "svertex", item: dot };
    const toCurve = ({ points }) => 1 - Math.max(...points.map((point) => dot3(point, at)));
    const arc = nearest(this.map.arcs, toCurve, 0.003);
    if (arc >= 0) return { kind: "sedge", item: arc };
    const circle = nearest(this.map.circles, toCurve, 0.003);
    if (circle >= 0) return { kind: "sloop", item: circle };
    return { kind: "sface", item: regionAt(this.map, at) };
  }
}
