// SPDX-License-Identifier: Apache-2.0
//
// Sets: an expression and the set that it describes, with what was there before.
import { pythonText, shellLine, showCommands } from "../commands.js";
import { ExpressionEditor } from "../editor.js";
import { fillNotes, fillTable, measureRows, secondsText } from "../measures.js";
import { ServerError } from "../server.js";
import { PartMover } from "../parts/part_mover.js";
import { SetQuestions } from "../parts/set_questions.js";
import { byId } from "../../../view/web/panel.js";

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
const MOST_OF_VERSIONS = 1e6; // characters

export class SetsPanel {
  // computing: see there; exportForm: where results go; changed(): the state is to be kept.
  constructor({ computing, exportForm, language, changed, viewer }) {
    Object.assign(this, { computing, exportForm, changed });
    this.name = "sets";
    this.sets = [];
    this.versions = []; // texts that gave a set, the oldest first
    this.version = -1; // the one that is shown
    this.editor = new ExpressionEditor(byId("sets-editor"), {
      label: "Expression of the set",
      functions: language.functions,
      onChange: () => {
        this.mover.forget();
        this.changed();
        this.#showCommands();
        if (byId("sets-live").checked) computing.soon(() => this.compute(), SETS_DELAY);
      },
    });
    this.editor.text = SET_EXAMPLES[0][1];
    this.mover = new PartMover({
      editor: this.editor,
      viewer,
      onChange: (dragged) => {
        this.changed();
        this.#showCommands();
        computing.next(() => this.compute(!dragged));
      },
      onPart: () => computing.next(() => this.compute(false)),
    });
    this.questions = new SetQuestions({
      editor: this.editor,
      onChange: (dragged) => {
        this.changed();
        this.#showCommands();
        if (dragged) computing.next(() => this.compute(false));
        else computing.soon(() => this.compute(false), SETS_DELAY);
      },
    });
    byId("sets-crossings").addEventListener("change", () => {
      this.changed();
      this.#showCommands();
      this.compute(false);
    });
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
    return { text: this.editor.text, live: byId("sets-live").checked, crossings: byId("sets-crossings").value,
      questions: this.questions.state, versions: this.versions, version: this.version };
  }

  set state({ text = "", live = true, crossings = "union", questions = {}, versions = [], version = -1 }) {
    this.editor.text = text;
    this.versions = Array.isArray(versions) ? versions.filter((one) => typeof one === "string").slice(-MOST_VERSIONS) : [];
    this.version = Number.isInteger(version) ? Math.min(Math.max(version, -1), this.versions.length - 1) : -1;
    this.questions.state = questions;
    this.#showVersion();
    this.mover.forget();
    byId("sets-crossings").value = crossings;
    byId("sets-live").checked = live;
    this.#showCommands();
  }

  // Another text in place of the one that is there.
  use(text) {
    this.editor.text = text;
    this.mover.forget();
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
      done = await this.computing.run(this.name,
        { text, part: this.mover.wanted, crossings: byId("sets-crossings").value, ...this.questions.request });
    } catch (error) {
      if (!(error instanceof ServerError)) throw error;
      this.#askAboutCrossings([error.message]);
      if (this.editor.text === text) this.editor.showError({ offset: error.field === "text" ? error.offset : 0, message: error.message });
      return;
    }
    if (!done) return;
    this.editor.showError(null);
    const { report, scene, seconds } = done;
    fillTable(byId("sets-measures"), [...measureRows(report.result),
      ["Time", `${secondsText(report.op_s)} to compute, ${secondsText(seconds)} until shown`]]);
    fillNotes(byId("sets-notes"), report.notes);
    this.#askAboutCrossings(report.notes);
    this.mover.found(report.part);
    this.questions.show(report, scene);
    this.sets = report.section ? ["result", "section"] : ["result"];
    this.exportForm.offer(this.sets);
    if (remember) this.#remember(text);
  }

  // "6 pairs of faces cross": whoever sees that may choose what is inside then. The choice stays in sight once it was made.
  #askAboutCrossings(lines) {
    const found = lines.map((line) => /\d+ pairs? of faces cross(es)?/.exec(line)?.[0]).find((words) => words);
    const chosen = byId("sets-crossings").value !== "union";
    byId("sets-crossing").hidden = !found && !chosen;
    byId("sets-crossing-text").textContent = found ? `${found[0].toUpperCase()}${found.slice(1)}. What is inside?` : "Where faces cross, inside is";
  }

  grab(x, y) {
    return this.mover.grab(x, y);
  }

  // A new version, behind the one that is shown; what was undone is forgotten.
  #remember(text) {
    if (this.versions[this.version] === text) return;
    this.versions.splice(this.version + 1);
    this.versions.push(text);
    const size = () => this.versions.reduce((sum, version) => sum + version.length, 0);
    while (this.versions.length > MOST_VERSIONS || (this.versions.length > 1 && size() > MOST_OF_VERSIONS)) this.versions.shift();
    this.version = this.versions.length - 1;
    this.#showVersion();
    this.changed();
  }

  #go(step) {
    const to = this.version + step;
    if (to < 0 || to >= this.versions.length) return;
    this.version = to;
    this.editor.text = this.versions[to];
    this.mover.forget();
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
    const rule = byId("sets-crossings").value;
    const { shell, python } = this.questions.commands;
    showCommands(byId("sets-commands"), [
      ["Command line", [shellLine("nef", "eval", text, "-o", "result.nef", ...(rule === "union" ? [] : ["--crossings", rule])), ...shell].join("\n")],
      ["Python", [`import nef\nresult = nef.eval(${pythonText(text)}, crossings="${rule}")`, ...python].join("\n")],
    ]);
  }
}
