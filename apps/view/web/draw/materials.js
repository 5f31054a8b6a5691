// SPDX-License-Identifier: Apache-2.0
//
// How facets, lines and dots look. Selected: solid facets, dark lines, dark dots. Not selected: striped facets, orange
// lines, white dots with an orange rim. `section` is shared: what lies on its positive side is cut away.
import * as THREE from "three";

const SECTION = `
uniform vec4 section;
varying vec3 vWorld;
void cutAway() { if (dot(section.xyz, vWorld) + section.w > 0.0) discard; }
`;

// What all materials of a view share. A section of zero normal and negative offset cuts nothing.
export function sharedUniforms() {
  return {
    section: { value: new THREE.Vector4(0, 0, 0, -1) },
    size: { value: new THREE.Vector2(1, 1) }, // of the canvas in device pixels
    ratio: { value: 1 }, // device pixels for each pixel
  };
}

// Attributes: front and back, the colours of both sides; their fourth component is how the facet is drawn:
// 0 solid, 1 striped (not selected), 0.5 faded (on the visible box).
// own: the colours are those of the surface, shown without light and shade; image: they come from it, by the attribute
// place.
export function facetMaterial(shared, opacity, own, image) {
  return new THREE.ShaderMaterial({
    uniforms: { ...shared, opacity, image: { value: image } },
    defines: { ...(own ? { OWN_COLORS: 1 } : {}), ...(image ? { IMAGE: 1 } : {}) },
    side: THREE.DoubleSide,
    polygonOffset: true,
    polygonOffsetFactor: 1,
    polygonOffsetUnits: 1,
    vertexShader: `
attribute vec4 front;
attribute vec4 back;
varying vec4 vFront;
varying vec4 vBack;
varying vec3 vWorld;
varying vec3 vEye;
#ifdef IMAGE
attribute vec2 place;
varying vec2 vPlace;
#endif
void main() {
#ifdef IMAGE
  vPlace = place;
#endif
  vFront = front;
  vBack = back;
  vec4 world = modelMatrix * vec4(position, 1.0);
  vWorld = world.xyz;
  vec4 eye = viewMatrix * world;
  vEye = eye.xyz;
  gl_Position = projectionMatrix * eye;
}`,
    fragmentShader: `
${SECTION}
uniform float opacity;
uniform float ratio;
varying vec4 vFront;
varying vec4 vBack;
varying vec3 vEye;
#ifdef IMAGE
uniform sampler2D image;
varying vec2 vPlace;
#endif
void main() {
  cutAway();
  vec4 side = gl_FrontFacing ? vFront : vBack;
#ifdef IMAGE
  if (side.a < 0.25) side.rgb = texture2D(image, vPlace).rgb;
#endif
  vec3 normal = normalize(cross(dFdx(vEye), dFdy(vEye)));
  float light = 0.55 + 0.36 * max(dot(normal, normalize(vec3(0.35, 0.65, 0.7))), 0.0) + 0.14 * max(normal.z, 0.0);
#ifdef OWN_COLORS
  if (side.a < 0.25) light = 1.0;
#endif
  vec3 color = side.rgb * light;
  float alpha = opacity;
  if (side.a > 0.75) {
    float stripe = mod((gl_FragCoord.x + gl_FragCoord.y) / ratio, 9.0);
    color = mix(color, vec3(0.99, 0.97, 0.94), stripe < 5.0 ? 0.9 : 0.12);
  } else if (side.a > 0.25) {
    color = mix(color, vec3(0.957, 0.965, 0.973), 0.62);
    vec2 cell = mod(gl_FragCoord.xy / ratio, 7.0);
    if (length(cell - 3.5) < 1.3) color *= 0.82;
  }
  gl_FragColor = vec4(color, alpha);
}`,
  });
}

// Quads: attributes start, end, color, and width in pixels; position tells the corner.
export function lineMaterial(shared) {
  return new THREE.ShaderMaterial({
    uniforms: { ...shared },
    vertexShader: `
uniform vec2 size;
uniform float ratio;
attribute vec3 start;
attribute vec3 end;
attribute vec4 color;
attribute float width;
varying vec4 vColor;
varying vec3 vWorld;
void main() {
  vec4 a = viewMatrix * modelMatrix * vec4(start, 1.0);
  vec4 b = viewMatrix * modelMatrix * vec4(end, 1.0);
  float near = -0.0001;
  if (a.z > near && b.z < near) a = mix(a, b, (a.z - near) / (a.z - b.z));
  if (b.z > near && a.z < near) b = mix(b, a, (b.z - near) / (b.z - a.z));
  vec4 p = projectionMatrix * a;
  vec4 q = projectionMatrix * b;
  vec2 along = (q.xy / q.w - p.xy / p.w) * size;
  along = length(along) > 0.0 ? normalize(along) : vec2(1.0, 0.0);
  vec4 here = position.x < 0.5 ? p : q;
  vec2 shift = vec2(-along.y, along.x) * position.y + along * (position.x * 2.0 - 1.0) * 0.5;
  here.xy += shift * width * ratio / size * here.w;
  here.z -= 0.0012 * here.w;
  gl_Position = here;
  vColor = color;
  vWorld = (modelMatrix * vec4(position.x < 0.5 ? start : end, 1.0)).xyz;
}`,
    fragmentShader: `
${SECTION}
varying vec4 vColor;
void main() {
  cutAway();
  gl_FragColor = vec4(vColor.rgb, 1.0);
}`,
  });
}

// Points: attributes fill, rim (colours) and diameter in pixels.
export function dotMaterial(shared) {
  return new THREE.ShaderMaterial({
    uniforms: { ...shared },
    vertexShader: `
uniform float ratio;
attribute vec4 fill;
attribute vec4 rim;
attribute float diameter;
varying vec4 vFill;
varying vec4 vRim;
varying float vDiameter;
varying vec3 vWorld;
void main() {
  vec4 world = modelMatrix * vec4(position, 1.0);
  vWorld = world.xyz;
  vFill = fill;
  vRim = rim;
  vDiameter = diameter * ratio;
  gl_Position = projectionMatrix * viewMatrix * world;
  gl_Position.z -= 0.004 * gl_Position.w;
  gl_PointSize = vDiameter;
}`,
    fragmentShader: `
${SECTION}
uniform float ratio;
varying vec4 vFill;
varying vec4 vRim;
varying float vDiameter;
void main() {
  cutAway();
  float r = length(gl_PointCoord - 0.5) * vDiameter;
  if (r > 0.5 * vDiameter) discard;
  gl_FragColor = vec4((r > 0.5 * vDiameter - 1.6 * ratio ? vRim : vFill).rgb, 1.0);
}`,
  });
}
