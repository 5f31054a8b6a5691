// SPDX-License-Identifier: Apache-2.0
//
// The controls beside the scene.
import { escaped } from "./item_text.js";
import { byLayer, INK_HEX, ORANGE_HEX } from "./draw/layer_view.js";

export const byId = (id) => document.getElementById(id);

// views: those of one name, of which the first one speaks for all.
function layerRow(views, onChange) {
  const [view] = views;
  const row = document.createElement("div");
  row.className = "layer";
  const box = Object.assign(document.createElement("input"), { type: "checkbox", checked: view.layer.visible });
  const name = document.createElement("label");
  name.className = "name";
  const swatch = document.createElement("span");
  swatch.className = "swatch";
  swatch.style.background = view.layer.color;
  name.append(swatch, view.layer.name);
  const opacity = Object.assign(document.createElement("input"),
    { type: "range", min: 0, max: 1, step: 0.01, value: view.layer.opacity, title: "Opacity" });
  opacity.setAttribute("aria-label", `Opacity of ${view.layer.name}`);
  box.setAttribute("aria-label", `Show ${view.layer.name}`);
  name.addEventListener("click", () => box.click());
  box.addEventListener("change", () => {
    for (const one of views) one.group.visible = box.checked;
    onChange();
  });
  opacity.addEventListener("input", () => {
    for (const one of views) one.setOpacity(Number(opacity.value));
    onChange();
  });
  row.append(box, name, opacity);
  return row;
}

export function makeLayerRows(views, onChange) {
  byId("layers").replaceChildren(...byLayer(views).map((some) => layerRow(some, onChange)));
}

const MOST_VOLUMES = 12; // that the legend names one by one

// The volumes of the layers that colour them one by one.
function volumeRows(page) {
  const rows = page.layers.flatMap((layer) => {
    const selected = layer.volumes.filter((volume) => volume.mark);
    const own = selected.length > 1 && new Set(selected.map((volume) => volume.color)).size > 1;
    if (!own) return [];
    const prefix = page.layers.length > 1 ? `${escaped(layer.name)}: ` : "";
    return selected.map(({ index, color, mark }) => `<div class="volume"><span class="swatch" style="background:${color}"></span>` +
      `${prefix}volume ${index ?? "cut by the section"}${mark > 1 ? `, label ${mark}` : ""}</div>`);
  });
  const more = rows.length - MOST_VOLUMES;
  return rows.slice(0, MOST_VOLUMES).join("") + (more > 0 ? `<div>and ${more} more volumes</div>` : "");
}

export function makeLegend(page) {
  const icon = (inner) => `<svg width="46" height="14" viewBox="0 0 46 14">${inner}</svg>`;
  const line = (color) => `<line x1="2" y1="7" x2="30" y2="7" stroke="${color}" stroke-width="2"/>`;
  byId("legend").innerHTML =
    `<div>${icon(`${line(INK_HEX)}<circle cx="39" cy="7" r="4.5" fill="${INK_HEX}"/>`)} selected edge, vertex</div>` +
    `<div>${icon(`${line(ORANGE_HEX)}<circle cx="39" cy="7" r="4" fill="#fff" stroke="${ORANGE_HEX}" stroke-width="1.6"/>`)} not selected</div>` +
    `<div>${icon('<defs><pattern id="s" width="6" height="6" patternUnits="userSpaceOnUse" patternTransform="rotate(45)"><rect width="6" height="6" fill="#fdf8f0"/><rect width="2.6" height="6" fill="#568fc4"/></pattern></defs><rect x="2" y="1" width="18" height="12" fill="#568fc4"/><rect x="24" y="1" width="18" height="12" fill="url(#s)"/>')} facet selected, not selected</div>` +
    (page.layers.some((layer) => layer.box)
      ? `<div>${icon('<line x1="2" y1="7" x2="44" y2="7" stroke="#8a949e" stroke-width="1.5" stroke-dasharray="5 4"/>')} the box where unbounded parts are cut off for the eye</div>` : "") +
    `<div>${icon('<rect x="2" y="1" width="40" height="12" fill="#568fc4" stroke="#1c2733" stroke-dasharray="3 2"/>')} a section's cut is filled where the set is, in its volume's colour</div>` +
    volumeRows(page);
}
