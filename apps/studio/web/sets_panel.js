// SPDX-License-Identifier: Apache-2.0
//
// Sets: an expression and the set that it describes, with what was there before.
import { pythonText, shellLine, showCommands } from "./commands.js";
import { ExpressionEditor } from "./editor.js";
import { fillNotes, fillTable, measureRows, secondsText } from "./measures.js";
import { ServerError } from "./server.js";
import { byId } from "../../view/web/panel.js";

const SET_EXAMPLES = [
  ["A box without a ball", "box(0,0,0, 2,2,2) - ball(6/5, 6)"],
  ["A pipe", "h = 5;\nouter = cylinder(h, 3/2);\ninner = cylinder(h, 1);\nouter - inner"],
  ["Two cubes that share an edge", "box(0,0,0, 1,1,1) + box(1,1,0, 2,2,1)"],
  ["An open cube with one corner closed", "interior(box(0,0,0, 1,1,1)) + point(0,0,0)"],
  ["A solid, a sheet and a wire", "box(0,0,0, 2,2,2) + polygon(2,0,0, 4,0,0, 4,0,2, 2,0,2) + segment(0,2,2, 0,4,3)"],
  ["A half-space without a cylinder", "halfspace(0,0,1,0) - translate(cylinder(4, 1), 0,0,-3)"],
  ["A rounded box", "minkowski(box(0,0,0, 3,2,1), ball(1/4, 3))"],
  ["A cube, turned by exactly 30 degrees or as near as a fraction", "a = box(-1,-1,-1, 1,1,1);\na - rotate(a, z, 30) * halfspace(0,0,-1,0)"],
];
const SETS_DELAY = 120; // milliseconds without a key before the text is computed
const MOST_VERSIONS = 200;

export class SetsPanel {
  // computing: see there; exportForm: where results go; changed(): the state is to be kept.
  constructor({ computing, exportForm, language, changed }) {
    Object.assign(this, { computing, exportForm, changed });
    this.name = "sets";
    this.sets = [];
    this.versions = []; // texts that gave a set, the oldest first
    this.version = -1; // the one that is shown
    this.editor = new ExpressionEditor(byId("sets-editor"), {
      label: "Expression of the set",
      functions: language.functions,
      onChange: () => {
        this.changed();
        this.#showCommands();
        if (byId("sets-live").checked) computing.soon(() => this.compute(), SETS_DELAY);
      },
    });
    this.editor.text = SET_EXAMPLES[0][1];
    const examples = byId("sets-example");
    examples.append(...SET_EXAMPLES.map(([name], i) => new Option(name, i)));
    examples.addEventListener("change", () => {
      if (examples.value === "") return;
      this.use(SET_EXAMPLES[Number(examples.value)][1]);
      examples.value = "";
    });
    byId("sets-compute").addEventListener("click", () => this.compute());
    byId("sets-undo").addEventListener("click", () => this.#go(-1));
    byId("sets-redo").addEventListener("click", () => this.#go(1));
    byId("sets-editor").addEventListener("keydown", (event) => {
      if (event.key === "Enter" && event.ctrlKey) this.compute();
    });
    this.#showVersion();
    this.#showCommands();
  }

  get state() {
    return { text: this.editor.text, live: byId("sets-live").checked };
  }

  set state({ text = "", live = true }) {
    this.editor.text = text;
    byId("sets-live").checked = live;
    this.#showCommands();
  }

  // Another text in place of the one that is there.
  use(text) {
    this.editor.text = text;
    this.changed();
    this.#showCommands();
    return this.compute();
  }

  // Unites a file with what is there.
  addFile(name) {
    const { text } = this.editor;
    const file = `file(${JSON.stringify(name)})`;
    return this.use(text.trim() && !SET_EXAMPLES.some(([, example]) => example === text) ? `${text.trimEnd()}\n  + ${file}` : file);
  }

  async compute(remember = true) {
    const { text } = this.editor;
    let done;
    try {
      done = await this.computing.run(this.name, { text });
    } catch (error) {
      if (!(error instanceof ServerError)) throw error;
      if (this.editor.text === text) this.editor.showError({ offset: error.field === "text" ? error.offset : 0, message: error.message });
      return;
    }
    if (!done) return;
    this.editor.showError(null);
    const { report, seconds } = done;
    fillTable(byId("sets-measures"), [...measureRows(report.result),
      ["Time", `${secondsText(report.op_s)} to compute, ${secondsText(seconds)} until shown`]]);
    fillNotes(byId("sets-notes"), report.notes);
    this.sets = ["result"];
    this.exportForm.offer(this.sets);
    if (remember) this.#remember(text);
  }

  // A new version, behind the one that is shown; what was undone is forgotten.
  #remember(text) {
    if (this.versions[this.version] === text) return;
    this.versions.splice(this.version + 1);
    this.versions.push(text);
    if (this.versions.length > MOST_VERSIONS) this.versions.shift();
    this.version = this.versions.length - 1;
    this.#showVersion();
  }

  #go(step) {
    const to = this.version + step;
    if (to < 0 || to >= this.versions.length) return;
    this.version = to;
    this.editor.text = this.versions[to];
    this.#showVersion();
    this.#showCommands();
    this.changed();
    this.compute(false);
  }

  #showVersion() {
    byId("sets-undo").disabled = this.version <= 0;
    byId("sets-redo").disabled = this.version + 1 >= this.versions.length;
    byId("sets-version").textContent = this.versions.length > 1 ? `${this.version + 1} of ${this.versions.length}` : "";
  }

  #showCommands() {
    const { text } = this.editor;
    showCommands(byId("sets-commands"), [
      ["Command line", shellLine("nef", "eval", text, "-o", "result.nef")],
      ["Python", `import nef\nresult = nef.eval(${pythonText(text)}, crossings="union")`],
    ]);
  }
}
