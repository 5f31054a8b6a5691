// SPDX-License-Identifier: Apache-2.0
//
// Hulls: a scene of cameras and masks, its views switched on and off.
import { shellLine, showCommands } from "../commands.js";
import { SliderField } from "../fields/slider_field.js";
import { fillNotes, fillTable, measureRows, secondsText } from "../measures.js";
import { offerScenes } from "./scene_list.js";
import { ServerError } from "../server.js";
import { byId } from "../../../view/web/panel.js";

const HULLS_DELAY = 30;

export class HullsPanel {
  constructor({ computing, exportForm, changed, viewer }) {
    Object.assign(this, { computing, exportForm, changed, viewer });
    this.name = "hulls";
    this.sets = [];
    this.scene = "";
    this.off = new Set(); // numbers of views
    this.overlay = null; // the number of the view whose image is shown
    byId("hulls-open").addEventListener("click", () => this.openFile(byId("hulls-file").value));
    byId("hulls-compute").addEventListener("click", () => this.compute());
    const slid = () => {
      this.changed();
      this.#showCommands();
      this.computing.next(() => this.compute());
    };
    this.simplify = new SliderField("hulls-simplify", "hulls-slider", { typed: () => this.#edited(200), slid });
    this.threshold = new SliderField("hulls-threshold", "hulls-level", { typed: () => this.#edited(300), slid });
    byId("hulls-mask").addEventListener("input", () => this.#edited(500));
    byId("hulls-colors").addEventListener("change", () => this.#edited());
    byId("hulls-residuals").addEventListener("change", () => this.#edited());
    byId("hulls-all").addEventListener("click", () => {
      this.off.clear();
      for (const box of document.querySelectorAll("#hulls-views input")) box.checked = true;
      this.#edited();
    });
    this.#showScene();
  }

  get state() {
    return { scene: this.scene, off: [...this.off].sort((a, b) => a - b), simplify: this.simplify.value,
      threshold: this.threshold.value, mask: byId("hulls-mask").value.trim(),
      residuals: byId("hulls-residuals").checked, colors: byId("hulls-colors").value };
  }

  set state({ scene = "", off = [], simplify = "1", threshold = "", mask = "", residuals = false, colors = "plain" }) {
    this.scene = scene;
    this.off = new Set(off);
    this.simplify.value = simplify;
    this.threshold.value = threshold;
    byId("hulls-mask").value = mask;
    byId("hulls-residuals").checked = residuals;
    byId("hulls-colors").value = colors;
    this.#showScene();
  }

  offerFiles(files) {
    offerScenes(byId("hulls-file"), byId("hulls-open"), files, [".json"]);
  }

  async openFile(file) {
    this.scene = file;
    this.off.clear();
    this.viewNames = [];
    this.overlay = null;
    byId("hulls-views").replaceChildren();
    this.#showScene();
    this.changed();
    await this.compute();
    this.viewer.reset();
  }

  // The hull fills the view at first; its cameras stand far around it.
  frame(scene) {
    const { xyz } = scene.layers[0].vertices;
    if (xyz.length === 0) return;
    const of = (best) => [0, 1, 2].map((axis) => {
      let found = xyz[axis];
      for (let i = axis; i < xyz.length; i += 3) found = best(found, xyz[i]);
      return found;
    });
    scene.focus = [of(Math.min), of(Math.max)];
  }

  #edited(delay = HULLS_DELAY) {
    this.changed();
    this.#showCommands();
    this.computing.soon(() => this.compute(), delay);
  }

  async compute() {
    if (!this.scene) return;
    let done;
    try {
      done = await this.computing.run(this.name, { ...this.state, overlay: this.overlay });
    } catch (error) {
      if (!(error instanceof ServerError)) throw error;
      byId("hulls-error").textContent = error.message;
      return;
    }
    if (!done) return;
    byId("hulls-error").textContent = "";
    const { report, seconds } = done;
    fillTable(byId("hulls-measures"), [...measureRows(report.result),
      ["Time", `outlines ${secondsText(report.outlines_s)}, hull ${secondsText(report.op_s)}, ${secondsText(seconds)} until shown`]]);
    fillNotes(byId("hulls-notes"), report.notes);
    this.#showViews(report.views);
    this.viewNames = report.views.map(({ name }) => name);
    this.#showCommands();
    this.#showOverlay(report);
    const { suspect } = report;
    byId("hulls-suspect").textContent = suspect === null ? "" : `${report.views[suspect].name} disagrees with the other views.`;
    this.sets = ["result"];
    this.exportForm.offer(this.sets);
  }

  // The boxes stay, so that the one that was just used keeps the focus.
  #showViews(views) {
    const list = byId("hulls-views");
    if (list.children.length !== views.length) {
      list.replaceChildren(...views.map(({ name }, number) => {
        const item = document.createElement("li");
        const box = Object.assign(document.createElement("input"), { type: "checkbox" });
        box.addEventListener("change", () => {
          if (box.checked) this.off.delete(number);
          else this.off.add(number);
          this.#edited();
        });
        const label = document.createElement("label");
        const residual = Object.assign(document.createElement("span"), { className: "residual" });
        const show = Object.assign(document.createElement("button"), { type: "button", textContent: "Image" });
        show.setAttribute("aria-label", `Image of ${name}`);
        show.addEventListener("click", () => {
          this.overlay = this.overlay === number ? null : number;
          this.compute();
        });
        label.append(box, ` ${name} `, residual);
        item.append(label, show);
        return item;
      }));
    }
    views.forEach(({ on, residual, inside }, number) => {
      const item = list.children[number];
      item.querySelector("input").checked = on;
      item.querySelector(".residual").textContent = residual === undefined ? ""
        : `${(100 * residual).toFixed(2)} %${inside === false ? ", not inside" : ""}`;
    });
  }

  // The image of a view with its outline (red), the hull over it (blue), and what the hull lacks of the outline (yellow).
  #showOverlay({ overlay, views }) {
    byId("hulls-overlay").hidden = !overlay;
    if (!overlay) return;
    byId("hulls-overlay-image").src = overlay.url;
    byId("hulls-overlay-name").textContent = views[overlay.view].name;
  }

  #showScene() {
    byId("hulls-title").textContent = this.scene || "Open a scene of cameras and masks (.json) of your folder above";
    byId("hulls-compute").disabled = !this.scene;
    this.#showCommands();
  }

  #showCommands() {
    const { scene, off, simplify, threshold, mask, colors } = this.state;
    const name = scene || "scene.json";
    const without = off.map((view) => this.viewNames?.[view] ?? String(view));
    const how = [...(without.length > 0 ? ["--without", ...without] : []), ...(simplify && simplify !== "0" ? ["--simplify", simplify] : []), ...(threshold ? ["--threshold", threshold] : []), ...(mask ? ["--mask", mask] : []),
      ...({ vertices: ["--color"], texture: ["--texture"] }[colors] ?? [])];
    const file = { plain: "hull.nef", vertices: "hull.ply", texture: "hull.glb" }[colors];
    const python = [JSON.stringify(name), ...(without.length > 0 ? [`without=${JSON.stringify(without)}`] : []),
      ...(colors === "texture" ? ["texture=True"] : []), ...(simplify && simplify !== "0" ? [`tolerance=${simplify}`] : []),
      ...(mask ? [`mask=${JSON.stringify(mask)}`] : []),
      ...(threshold ? [`threshold=${/^[\d.]+$/.test(threshold) ? threshold : JSON.stringify(threshold)}`] : [])];
    showCommands(byId("hulls-commands"), [
      ["Command line", shellLine("visual_hull", name, "-o", file, ...how)],
      ["Python", `import nef.visual_hull\nhull = nef.visual_hull.read(${python.join(", ")})${colors === "texture" ? '\nhull.texture.write("hull.glb")' : ""}`],
    ]);
  }
}
