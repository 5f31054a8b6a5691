// SPDX-License-Identifier: Apache-2.0
//
// Frames whose edges are smooth: four samples a pixel. The canvas itself has one, for frames that must not take long: a
// processor that stands in for a graphics card spends several times as much on a small triangle of four samples.
import * as THREE from "three";

const SAMPLES = 4;

export class SmoothFrame {
  constructor(renderer) {
    this.renderer = renderer;
    this.target = new THREE.WebGLRenderTarget(1, 1, { samples: SAMPLES, stencilBuffer: true });
    const copy = new THREE.ShaderMaterial({
      uniforms: { image: { value: this.target.texture } },
      depthTest: false,
      depthWrite: false,
      vertexShader: "void main() { gl_Position = vec4(position.xy, 0.0, 1.0); }",
      fragmentShader: `
uniform sampler2D image;
void main() { gl_FragColor = texelFetch(image, ivec2(gl_FragCoord.xy), 0); }`,
    });
    this.scene = new THREE.Scene();
    const all = new THREE.Mesh(new THREE.PlaneGeometry(2, 2), copy);
    all.frustumCulled = false;
    this.scene.add(all);
    this.camera = new THREE.Camera();
  }

  // Draws by `render`, in all pixels of the canvas.
  draw(render) {
    const { x: width, y: height } = this.renderer.getDrawingBufferSize(new THREE.Vector2());
    if (this.target.width !== width || this.target.height !== height) this.target.setSize(width, height);
    this.renderer.setRenderTarget(this.target);
    render();
    this.renderer.setRenderTarget(null);
    this.renderer.render(this.scene, this.camera);
  }
}
