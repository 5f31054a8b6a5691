// SPDX-License-Identifier: Apache-2.0
//
// Sums: two operands and what is made of them; offsets by a slider, between certified bounds.
import { pythonNumber, pythonText, shellLine, showCommands } from "../commands.js";
import { ExpressionEditor } from "../editor.js";
import { approximately } from "../exact.js";
import { SliderField } from "../fields/slider_field.js";
import { areaText, fillNotes, fillTable, measureRows, secondsText } from "../measures.js";
import { ServerError } from "../server.js";
import { byId } from "../../../view/web/panel.js";

const SUMS_DELAY = 200;
const REACHED = ["positions", "touched", "untouched"];
const FLAGS = { sum: [], erosion: ["--erode"], opening: ["--open"], closing: ["--close"], penetration: ["--penetration"] };
const FUNCTIONS = { sum: "sum", erosion: "erode", opening: "opening", closing: "closing", penetration: "penetration" };

export class SumsPanel {
  constructor({ computing, exportForm, language, changed }) {
    Object.assign(this, { computing, exportForm, changed });
    this.name = "sums";
    this.sets = [];
    const edited = () => {
      this.#changed();
      this.computing.soon(() => this.compute(), SUMS_DELAY);
    };
    const editor = (id, label) => new ExpressionEditor(byId(id), { label, functions: language.functions, onChange: edited });
    this.a = editor("sums-a", "Operand A");
    this.b = editor("sums-b", "Operand B");
    this.a.text = "box(0,0,0, 3,2,1) - box(1,1,0, 2,2,1)";
    this.b.text = "ball(1/4, 2)";
    byId("sums-kind").addEventListener("change", edited);
    byId("sums-splits").addEventListener("change", edited);
    byId("sums-from").addEventListener("input", edited);
    this.radius = new SliderField("sums-radius", "sums-slider", { typed: edited, slid: () => {
      this.#changed();
      this.computing.next(() => this.compute());
    } });
    byId("sums-compute").addEventListener("click", () => this.compute());
    this.#changed();
  }

  get state() {
    return { a: this.a.text, b: this.b.text, kind: byId("sums-kind").value, radius: this.radius.value,
      splits: Number(byId("sums-splits").value), from: byId("sums-from").value.trim() };
  }

  set state(state) {
    this.a.text = state.a ?? "";
    this.b.text = state.b ?? "";
    byId("sums-kind").value = state.kind ?? "sum";
    this.radius.value = state.radius ?? "0.1";
    byId("sums-from").value = state.from ?? "";
    byId("sums-splits").value = state.splits ?? 3;
    this.#changed(false);
  }

  #changed(keep = true) {
    const { kind } = this.state;
    byId("sums-b-field").hidden = kind === "offset";
    byId("sums-offset").hidden = kind !== "offset";
    byId("sums-reach").hidden = kind !== "reach";
    byId("sums-a-name").textContent = kind === "reach" ? "A, the part" : "A";
    byId("sums-b-name").textContent = kind === "reach" ? "B, the tool" : "B";
    const commands = { offset: () => this.#offsetCommands(), reach: () => this.#reachCommands() };
    showCommands(byId("sums-commands"), (commands[kind] ?? (() => this.#sumCommands()))());
    if (keep) this.changed();
  }

  #offsetCommands() {
    const { radius, splits, a } = this.state;
    return [
      ["Command line", `${shellLine("nef", "eval", a, "-o", "a.nef")}\n` +
        `${shellLine("minkowski", "a.nef", "--offset", `${radius},${splits}`, "--inner", "-o", "inner.nef")}\n` +
        shellLine("minkowski", "a.nef", "--offset", `${radius},${splits}`, "--outer", "-o", "outer.nef")],
      ["Python", `from fractions import Fraction\nimport nef, nef.minkowski\na = nef.eval(${pythonText(a)})\n` +
        ["inner", "outer"].map((side) => `${side} = nef.minkowski.offset(a, ${pythonNumber(radius)}, ${splits}, "${side}")`).join("\n")],
    ];
  }

  #operandCommands() {
    const { a, b } = this.state;
    return [`${shellLine("nef", "eval", a, "-o", "a.nef")}\n${shellLine("nef", "eval", b, "-o", "b.nef")}\n`,
      `import nef, nef.minkowski\na = nef.eval(${pythonText(a)})\nb = nef.eval(${pythonText(b)})\n`];
  }

  #reachCommands() {
    const { from } = this.state;
    const [shell, python] = this.#operandCommands();
    const start = from.split(",").map((number) => pythonText(number.trim())).join(", ");
    return [
      ["Command line", shell + shellLine("minkowski", "b.nef", "a.nef", "--reach", ...(from ? ["--from", from] : []), "-o", "positions.nef",
        "--touched", "touched.nef", "--untouched", "untouched.nef")],
      ["Python", `${python}reach = nef.minkowski.reach(b, a${from ? `, (${start})` : ""})`],
    ];
  }

  #sumCommands() {
    const { kind } = this.state;
    const [shell, python] = this.#operandCommands();
    return [
      ["Command line", shell + shellLine("minkowski", "a.nef", "b.nef", ...FLAGS[kind], ...(kind === "penetration" ? [] : ["-o", "result.nef"]))],
      ["Python", `${python}result = nef.minkowski.${FUNCTIONS[kind]}(a, b)`],
    ];
  }

  async compute() {
    const { state } = this;
    let done;
    try {
      done = await this.computing.run(this.name, state);
    } catch (error) {
      if (!(error instanceof ServerError)) throw error;
      this.#showError(error);
      return;
    }
    if (!done) return;
    this.#showError(null);
    const { report, seconds } = done;
    const rows = [];
    if (report.kind) {
      const way = report.translation.join(", ");
      rows.push(["They", report.kind], ["Shortest translation of B to contact", way],
        ["Its length", String(Math.sqrt(approximately(report.squared_length)))]);
    } else if (report.touched !== undefined) {
      for (const name of REACHED.slice(1)) rows.push([`Boundary ${name}`, report[name] ? areaText(report[name]) : "none"]);
    } else if (report.outer) {
      rows.push(...measureRows(report.result).map(([name, text]) => [`${name}, inner`, text]),
        ...measureRows(report.outer).slice(0, 2).map(([name, text]) => [`${name}, outer`, text]));
      if (report.error) rows.push(["Radius is off by at most", report.error.toPrecision(3)]);
    } else {
      rows.push(...measureRows(report.result));
    }
    fillTable(byId("sums-measures"), [...rows, ["Time", `${secondsText(report.op_s)} to compute, ${secondsText(seconds)} until shown`]]);
    fillNotes(byId("sums-notes"), report.notes);
    this.sets = report.outer ? ["result", "outer"] : report.touched !== undefined ? REACHED : ["result"];
    this.exportForm.offer(this.sets);
  }

  #showError(error) {
    for (const field of ["a", "b"]) {
      this[field].showError(error?.field === field ? { offset: error.offset, message: error.message } : null);
    }
    byId("sums-error").textContent = error && error.field !== "a" && error.field !== "b" ? error.message : "";
  }
}
