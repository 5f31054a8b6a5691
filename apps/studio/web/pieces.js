// SPDX-License-Identifier: Apache-2.0
//
// Scenes that come in pieces, each with coordinates about a centre of its own, so that a piece stays as it is while others
// change.

// The layer of a piece's scene. It is the same object in all scenes that have the piece, which is how the viewer knows it.
export function pieceOf(scene) {
  const [layer] = scene.layers;
  layer.piece = { center: scene.center, bounds: scene.bounds };
  return layer;
}

// Adds pieces to a scene, behind its own layers. Its coordinates stay about its centre, if it has any.
export function putTogether(scene, layers) {
  const boxes = layers.map(({ piece: { center, bounds } }) => bounds.map((corner) => corner.map((x, i) => x + center[i])));
  const absolute = (box) => box.map((corner) => corner.map((x, i) => x + scene.center[i]));
  const around = (own) => {
    const all = own ? [absolute(own), ...boxes] : boxes;
    const end = (k, best) => [0, 1, 2].map((i) => all.reduce((found, box) => best(found, box[k][i]), all[0][k][i]));
    return [end(0, Math.min), end(1, Math.max)];
  };
  const [bounds, focus] = [around(scene.bounds), around(scene.focus)];
  if (scene.layers.length === 0) scene.center = bounds[0].map((x, i) => (x + bounds[1][i]) / 2);
  const relative = (box) => box.map((corner) => corner.map((x, i) => x - scene.center[i]));
  Object.assign(scene, { bounds: relative(bounds), focus: relative(focus) });
  for (const layer of layers) layer.offset = layer.piece.center.map((x, i) => x - scene.center[i]);
  scene.layers = [...scene.layers, ...layers];
}
