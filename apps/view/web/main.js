// SPDX-License-Identifier: Apache-2.0
//
// A page with one scene, which is written into it.
import { byId } from "./panel.js";
import { loadScene } from "./scene_data.js";
import { Viewer } from "./viewer.js";

async function start() {
  const message = byId("message");
  try {
    const viewer = new Viewer(await loadScene(byId("scene-data").textContent));
    viewer.draw();
    message.textContent = "";
    window.nefViewer = viewer;
  } catch (error) {
    message.textContent = `The scene cannot be shown: ${error.message}`;
    throw error;
  }
}

start();
