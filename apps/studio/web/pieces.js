// SPDX-License-Identifier: Apache-2.0
//
// Scenes that come in pieces, each with coordinates about a centre of its own, so that a piece stays as it is while others
// change.

const shifted = (box, by) => box.map((corner) => corner.map((x, i) => x + by[i]));
const opposite = (vector) => vector.map((x) => -x);

// The layer of a piece's scene. It is the same object in all scenes that have the piece, which is how the viewer knows it.
export function pieceOf(scene) {
  const [layer] = scene.layers;
  layer.piece = { center: scene.center, box: shifted(scene.bounds, scene.center) };
  return layer;
}

// The box around boxes.
function boxAround(boxes) {
  const [low, high] = shifted(boxes[0], [0, 0, 0]);
  for (const [from, to] of boxes) {
    for (let i = 0; i < 3; ++i) {
      if (from[i] < low[i]) low[i] = from[i];
      if (to[i] > high[i]) high[i] = to[i];
    }
  }
  return [low, high];
}

// Adds pieces to a scene, behind its own layers. Its coordinates stay about its centre, if it has any.
export function putTogether(scene, layers) {
  const ofPieces = boxAround(layers.map(({ piece }) => piece.box));
  const [bounds, focus] = [scene.bounds, scene.focus].map((own) => (own ? boxAround([shifted(own, scene.center), ofPieces]) : ofPieces));
  if (scene.layers.length === 0) scene.center = bounds[0].map((x, i) => (x + bounds[1][i]) / 2);
  const back = opposite(scene.center);
  Object.assign(scene, { bounds: shifted(bounds, back), focus: shifted(focus, back) });
  for (const layer of layers) layer.offset = layer.piece.center.map((x, i) => x - scene.center[i]);
  scene.layers = [...scene.layers, ...layers];
}
