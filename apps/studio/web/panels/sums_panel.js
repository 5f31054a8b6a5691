// SPDX-License-Identifier: Apache-2.0
//
// Sums: two operands and what is made of them; offsets by a slider, between certified bounds.
import { pythonNumber, pythonText, shellLine, showCommands } from "../commands.js";
import { ExpressionEditor } from "../editor.js";
import { approximately } from "../exact.js";
import { fillNotes, fillTable, measureRows, secondsText } from "../measures.js";
import { ServerError } from "../server.js";
import { byId } from "../../../view/web/panel.js";

const SUMS_DELAY = 200;
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
    byId("sums-radius").addEventListener("input", () => {
      byId("sums-slider").value = approximately(byId("sums-radius").value);
      edited();
    });
    byId("sums-slider").addEventListener("input", () => {
      byId("sums-radius").value = byId("sums-slider").value;
      this.#changed();
      this.computing.next(() => this.compute());
    });
    byId("sums-compute").addEventListener("click", () => this.compute());
    this.#changed();
  }

  get state() {
    return { a: this.a.text, b: this.b.text, kind: byId("sums-kind").value, radius: byId("sums-radius").value,
      splits: Number(byId("sums-splits").value) };
  }

  set state(state) {
    this.a.text = state.a ?? "";
    this.b.text = state.b ?? "";
    byId("sums-kind").value = state.kind ?? "sum";
    byId("sums-radius").value = state.radius ?? "0.1";
    byId("sums-slider").value = approximately(byId("sums-radius").value);
    byId("sums-splits").value = state.splits ?? 3;
    this.#changed(false);
  }

  #changed(keep = true) {
    const { kind, radius, splits, a, b } = this.state;
    const offset = kind === "offset";
    byId("sums-b-field").hidden = offset;
    byId("sums-offset").hidden = !offset;
    showCommands(byId("sums-commands"), offset ? [
      ["Command line", `${shellLine("nef", "eval", a, "-o", "a.nef")}\n` +
        `${shellLine("minkowski", "a.nef", "--offset", `${radius},${splits}`, "--inner", "-o", "inner.nef")}\n` +
        shellLine("minkowski", "a.nef", "--offset", `${radius},${splits}`, "--outer", "-o", "outer.nef")],
      ["Python", `from fractions import Fraction\nimport nef, nef.minkowski\na = nef.eval(${pythonText(a)})\n` +
        ["inner", "outer"].map((side) => `${side} = nef.minkowski.offset(a, ${pythonNumber(radius)}, ${splits}, "${side}")`).join("\n")],
    ] : [
      ["Command line", `${shellLine("nef", "eval", a, "-o", "a.nef")}\n${shellLine("nef", "eval", b, "-o", "b.nef")}\n` +
        shellLine("minkowski", "a.nef", "b.nef", ...FLAGS[kind], ...(kind === "penetration" ? [] : ["-o", "result.nef"]))],
      ["Python", `import nef, nef.minkowski\na = nef.eval(${pythonText(a)})\nb = nef.eval(${pythonText(b)})\n` +
        `result = nef.minkowski.${FUNCTIONS[kind]}(a, b)`],
    ]);
    if (keep) this.changed();
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
    } else if (report.outer) {
      rows.push(...measureRows(report.result).map(([name, text]) => [`${name}, inner`, text]),
        ...measureRows(report.outer).slice(0, 2).map(([name, text]) => [`${name}, outer`, text]));
      if (report.error) rows.push(["Radius is off by at most", report.error.toPrecision(3)]);
    } else {
      rows.push(...measureRows(report.result));
    }
    fillTable(byId("sums-measures"), [...rows, ["Time", `${secondsText(report.op_s)} to compute, ${secondsText(seconds)} until shown`]]);
    fillNotes(byId("sums-notes"), report.notes);
    this.sets = report.outer ? ["result", "outer"] : ["result"];
    this.exportForm.offer(this.sets);
  }

  #showError(error) {
    for (const field of ["a", "b"]) {
      this[field].showError(error?.field === field ? { offset: error.offset, message: error.message } : null);
    }
    byId("sums-error").textContent = error && error.field !== "a" && error.field !== "b" ? error.message : "";
  }
}
