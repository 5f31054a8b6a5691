// SPDX-License-Identifier: Apache-2.0
//
// What is asked about a set besides its measures: an exact section, the distance of two parts, colours by shapes.
import { pythonText, shellLine } from "../commands.js";
import { SliderField } from "../fields/slider_field.js";
import { fillTable } from "../measures.js";
import { ask } from "../server.js";
import { byId } from "../../../view/web/panel.js";
import { partAt, withDefinitions } from "./part_at.js";

const SECTION_AXES = ["x", "y", "z"];

export class SetQuestions {
  // editor: of the set's text. onChange(dragged): something else is asked.
  constructor({ editor, onChange }) {
    Object.assign(this, { editor });
    this.svg = "";
    const changed = () => onChange(false);
    this.offset = new SliderField("exact-offset", "exact-slider", {
      typed: changed,
      slid: () => {
        byId("exact-on").checked = true;
        onChange(true);
      },
    });
    for (const id of ["exact-on", "exact-axis", "shapes-on"]) byId(id).addEventListener("change", changed);
    for (const end of ["from", "to"]) {
      byId(`distance-${end}`).addEventListener("input", changed);
      byId(`distance-${end}-here`).addEventListener("click", () => {
        const part = partAt(editor.text, editor.area.selectionStart);
        if (!part) return;
        byId(`distance-${end}`).value = editor.text.slice(part.begin, part.end);
        changed();
      });
    }
    byId("exact-save").addEventListener("click", () => this.#save());
  }

  get #fields() {
    return { section: byId("exact-on").checked, axis: byId("exact-axis").value, offset: this.offset.value,
      from: byId("distance-from").value, to: byId("distance-to").value, shapes: byId("shapes-on").checked };
  }

  // "request" is for who runs the state without a page.
  get state() {
    return { ...this.#fields, request: this.request };
  }

  set state({ section = false, axis = "z", offset = "0", from = "", to = "", shapes = false }) {
    byId("exact-on").checked = section;
    byId("exact-axis").value = axis;
    this.offset.value = offset;
    byId("distance-from").value = from;
    byId("distance-to").value = to;
    byId("shapes-on").checked = shapes;
    byId("sets-questions").open ||= section || shapes || Boolean(from && to);
  }

  // A part of the text as it stands there means the same with the definitions before its end.
  #meaning(part) {
    if (!part.trim()) return "";
    const { text } = this.editor;
    return withDefinitions(`${text.slice(0, text.lastIndexOf(";") + 1)}${part}`, { begin: text.lastIndexOf(";") + 1, end: Infinity });
  }

  get request() {
    const { section, axis, offset, from, to, shapes } = this.#fields;
    return { section: section ? { axis: SECTION_AXES.indexOf(axis), offset } : null, from: this.#meaning(from), to: this.#meaning(to), shapes };
  }

  // The answers in a report; scene: where the set is.
  show({ section, distance, question_error: error }, scene) {
    byId("questions-error").textContent = error ? `${error.field}: ${error.error}` : "";
    this.#fitSlider(scene);
    this.svg = section?.svg ?? "";
    byId("exact-picture").hidden = !section;
    if (section) byId("exact-image").src = `data:image/svg+xml;base64,${btoa(section.svg)}`;
    byId("exact-save").disabled = !section;
    const rows = [];
    if (section) {
      const counts = ["polygons", "segments", "points"].filter((name) => section[name] > 0).map((name) => `${section[name]} ${section[name] === 1 ? name.slice(0, -1) : name}`);
      rows.push(["Section", `${counts.join(", ") || "nothing"}${section.polygons ? `, area ${Number(section.area.toPrecision(8))}` : ""}`]);
      if (section.unbounded) rows.push(["", `${section.unbounded} unbounded parts are not drawn`]);
    }
    if (distance) {
      rows.push(["Distance", distance.squared === "0" ? `0: ${distance.contact}` : `${Number(distance.length.toPrecision(10))}, the root of ${distance.squared}`],
        ["From", distance.from.join(", ")], ["To", distance.to.join(", ")]);
    }
    fillTable(byId("questions-measures"), rows);
  }

  // Steps of the slider are decimals of about a hundredth of the set.
  #fitSlider({ focus, center }) {
    if (!focus) return;
    const k = SECTION_AXES.indexOf(byId("exact-axis").value);
    const [low, high] = focus.map((corner) => corner[k] + center[k]);
    const step = 10 ** Math.floor(Math.log10(Math.max(high - low, 1e-12) / 50));
    const { slider } = this.offset;
    Object.assign(slider, { step, min: Math.floor(low / step) * step, max: Math.ceil(high / step) * step });
    this.offset.value = this.offset.value; // the slider may reach it now
  }

  get commands() {
    const { section, axis, offset, from, to } = this.#fields;
    const plane = SECTION_AXES.map((name) => Number(name === axis));
    const negated = offset.startsWith("-") ? offset.slice(1) : `-${offset}`;
    const shell = [];
    const python = [];
    if (section) {
      shell.push(shellLine("nef", "section", "result.nef", `--plane=${[...plane, negated].join(",")}`, "-o", "section.svg"));
      python.push(`section = result.section((${plane.join(", ")}), ${pythonText(negated)})`);
    }
    if (from.trim() && to.trim()) {
      [["from", from], ["to", to]].forEach(([name, part]) => shell.push(shellLine("nef", "eval", this.#meaning(part), "-o", `${name}.nef`)));
      shell.push(shellLine("nef", "distance", "from.nef", "to.nef"));
      python.push(`distance = nef.eval(${pythonText(this.#meaning(from))}).distance(nef.eval(${pythonText(this.#meaning(to))}))`);
    }
    return { shell, python };
  }

  async #save() {
    const said = byId("exact-saved");
    try {
      const name = `${byId("exact-name").value}.svg`;
      await ask("write", { name, text: this.svg, overwrite: byId("export-overwrite").checked });
      said.className = "";
      said.textContent = `${name} written`;
    } catch (error) {
      said.className = "error";
      said.textContent = error.message;
    }
  }
}
