// SPDX-License-Identifier: Apache-2.0
//
// Planner: a scene of a file, its ends and obstacles moved by numbers or by the mouse, and the answer.
import { shellLine, showCommands } from "../commands.js";
import { addDecimals, approximately, decimalNear } from "../exact.js";
import { fillNotes, fillTable, secondsText } from "../measures.js";
import { fillOmpl, fillPassages, STATUS_SENTENCES } from "./planner_answer.js";
import { offerScenes } from "./scene_list.js";
import { ask, ServerError } from "../server.js";
import { byId } from "../../../view/web/panel.js";

const PLANNER_DELAY = 60;
const EXAMPLE = JSON.stringify({
  robot: "box(0,0,0, 1,1,1)",
  obstacles: ["box(-1,-1,-1, 10,4,4) - interior(box(0,0,0, 9,3,3))", "box(4,0,0, 5,3,3) - box(4,1,1, 5,2,2)"],
  start: [1, "1/2", "1/2"],
  goal: [7, "3/2", "3/2"],
}, null, 2);
const AXES = ["x", "y", "z"];
const ZERO = ["0", "0", "0"];

// Numbers of JSON keep their digits as texts, since 0.1 is one tenth here.
const spelledNumbers = (text) => text.replaceAll(/("(?:[^"\\]|\\.)*")|(-?\d+\.?\d*(?:[eE][+-]?\d+)?)/g,
  (all, quoted, number) => quoted ?? `"${number}"`);

// The numbers of a start or goal in JSON: of a position, and of a turn behind it.
function numbersOf(end) {
  if (Array.isArray(end)) return end;
  return Array.isArray(end?.position) ? [...end.position, ...(Array.isArray(end.quaternion) ? end.quaternion : [])] : [];
}

export class PlannerPanel {
  constructor({ computing, exportForm, changed, viewer, language }) {
    Object.assign(this, { computing, exportForm, changed, viewer });
    this.name = "planner";
    this.sets = [];
    this.moves = {}; // by the number of an obstacle
    this.obstacle = 0; // the one whose numbers are shown
    this.fields = {};
    for (const point of ["start", "goal", "move"]) this.fields[point] = this.#makeFields(point);
    byId("planner-open").addEventListener("click", () => this.openFile(byId("planner-file").value));
    byId("planner-obstacle").addEventListener("change", () => {
      this.obstacle = Number(byId("planner-obstacle").value);
      this.#showMove();
      if (byId("planner-drag").checked) this.#edited();
    });
    for (const point of ["start", "goal"]) byId(`planner-${point}-turn`).addEventListener("input", () => this.#edited());
    byId("planner-ompl").append(...language.planners.map((name) => new Option(name, name)));
    for (const id of ["planner-free", "planner-drag", "planner-ompl", "planner-seconds"]) byId(id).addEventListener("change", () => this.#edited());
    byId("planner-compute").addEventListener("click", () => this.compute());
    byId("planner-save").addEventListener("click", () => this.#save());
    this.#setScene({ text: EXAMPLE, file: "", folder: "" });
  }

  // An item that was clicked: its obstacle becomes the one that the numbers move.
  selected(item) {
    const found = item && /^obstacle (\d+)$/.exec(this.viewer.views[item.layer].layer.name);
    if (!found) return;
    this.obstacle = Number(found[1]);
    this.#showMove();
  }

  #makeFields(point) {
    return AXES.map((axis) => {
      const input = Object.assign(document.createElement("input"), { type: "text", inputMode: "decimal", id: `planner-${point}-${axis}` });
      input.setAttribute("aria-label", `${point === "move" ? "Move of the obstacle" : point} ${axis}`);
      input.addEventListener("input", () => {
        if (point === "move") this.moves[this.obstacle] = this.fields.move.map(({ value }) => value);
        this.#edited();
      });
      input.addEventListener("keydown", (event) => {
        const step = { ArrowUp: "", ArrowDown: "-" }[event.key];
        if (step === undefined) return;
        event.preventDefault();
        input.value = addDecimals(input.value || "0", `${step}${event.shiftKey ? "1" : "0.1"}`);
        input.dispatchEvent(new Event("input"));
      });
      byId(`planner-${point}`).append(input);
      return input;
    });
  }

  get state() {
    const { text, file, folder } = this.scene;
    return { text, file, folder, moves: this.moves, free: byId("planner-free").checked, ompl: byId("planner-ompl").value,
      seconds: Number(byId("planner-seconds").value) || 5, start: this.#point("start"), goal: this.#point("goal") };
  }

  set state({ text, file = "", folder = "", moves = {}, free = false, ompl = "", seconds = 5, start, goal }) {
    if (typeof text !== "string") return;
    this.#setScene({ text, file, folder });
    this.moves = moves;
    byId("planner-free").checked = free;
    byId("planner-ompl").value = ompl;
    byId("planner-seconds").value = seconds;
    if (start) this.#setPoint("start", start);
    if (goal) this.#setPoint("goal", goal);
    this.#showMove();
    this.#showCommands();
  }

  // Names of files that may be scenes.
  offerFiles(files) {
    offerScenes(byId("planner-file"), byId("planner-open"), files, [".json", ".cfg"]);
  }

  async openFile(file) {
    try {
      const { text } = await ask("read", { name: file });
      this.#setScene({ text, file, folder: file.includes("/") ? file.slice(0, file.lastIndexOf("/")) : "" });
      this.changed();
      await this.compute();
      this.viewer.reset();
    } catch (error) {
      this.#showError(error.message);
    }
  }

  #setScene(scene) {
    this.scene = scene;
    this.moves = {};
    let json = {};
    try {
      json = JSON.parse(spelledNumbers(scene.text));
    } catch {
      // the server says what is wrong with it
    }
    this.#setPoint("start", numbersOf(json.start));
    this.#setPoint("goal", numbersOf(json.goal));
    this.#showTurns();
    this.#offerObstacles(Array.isArray(json.obstacles) ? json.obstacles : []);
    byId("planner-title").textContent = scene.file || "An example; open a scene (.json or .cfg) of your folder above";
    this.#showMove();
    this.#showCommands();
  }

  #offerObstacles(names) {
    byId("planner-obstacle").replaceChildren(...names.map((name, i) => new Option(`${i}: ${name}`.slice(0, 60), i)));
    this.obstacle = 0;
  }

  // A position, and degrees or a quaternion behind it if the robot turns; null if a coordinate is missing.
  #point(name) {
    const numbers = this.fields[name].map(({ value }) => value.trim());
    if (numbers.some((number) => number === "")) return null;
    return [...numbers, ...this.#turn(name)];
  }

  #turn(name) {
    return byId(`planner-${name}-turn`).value.split(/[\s,]+/).filter((number) => number !== "");
  }

  #setPoint(name, numbers) {
    this.fields[name].forEach((input, i) => (input.value = numbers[i] ?? ""));
    if (name !== "move") byId(`planner-${name}-turn`).value = numbers.slice(3).join(", ");
  }

  // The fields of turns are there if the scene has some.
  #showTurns() {
    for (const name of ["start", "goal"]) {
      const field = byId(`planner-${name}-turn`);
      field.hidden = field.value === "";
      const what = field.value.includes(",") ? "turn as a quaternion w, x, y, z" : "turn in degrees";
      field.setAttribute("aria-label", `${name}: ${what}`);
      field.title = what;
    }
  }

  // What the text of the scene does not say in JSON.
  #takeEnds(report) {
    for (const name of ["start", "goal"]) {
      if (report[name] && !this.#point(name)) this.#setPoint(name, report[name]);
    }
    if (byId("planner-obstacle").options.length !== report.obstacles.length) this.#offerObstacles(report.obstacles);
    this.#showTurns();
    this.#showMove();
    this.#showCommands();
  }

  #showMove() {
    byId("planner-obstacle").value = this.obstacle;
    this.#setPoint("move", this.moves[this.obstacle] ?? ZERO);
  }

  #edited(delay = PLANNER_DELAY) {
    this.changed();
    this.#showCommands();
    this.computing.soon(() => this.compute(), delay);
  }

  #dragged() {
    this.changed();
    this.#showCommands();
    this.computing.next(() => this.compute(true));
  }

  #movesThatMove() {
    return Object.fromEntries(Object.entries(this.moves).filter(([, move]) => move.some((x) => x.trim() !== "0")));
  }

  // With the one that may be dragged, which then is a layer of its own, however many there are.
  #movesWanted() {
    const moves = this.#movesThatMove();
    if (byId("planner-drag").checked) moves[this.obstacle] = this.moves[this.obstacle] ?? ZERO;
    return moves;
  }

  async compute(dragged = false) {
    const { text, folder, start, goal, free, ompl, seconds } = this.state;
    let done;
    try {
      done = await this.computing.run(this.name,
        { scene: text, folder, start, goal, free, ompl, seconds, moves: this.#movesWanted(), dragged });
    } catch (error) {
      if (!(error instanceof ServerError)) throw error;
      this.#showError(error.message);
      return;
    }
    if (!done) return;
    this.#showError("");
    this.#showAnswer(done);
  }

  #showAnswer({ report, seconds }) {
    const { answer } = report;
    if (!this.#point("start") || !this.#point("goal")) this.#takeEnds(report);
    const status = byId("planner-status");
    status.className = `status ${answer.status}`;
    status.textContent = STATUS_SENTENCES[answer.status]?.(answer) ?? answer.status;
    const rows = [];
    if (answer.motions !== "translation") rows.push(["Motions", answer.motions]);
    if (answer.waypoints) rows.push(["Way-points", String(answer.waypoints)]);
    if (answer.cells > 0) rows.push(["Cells of angles", String(answer.cells)]);
    if (answer.status === "infeasible" && answer.boxes > 0) rows.push(["Proof", `${answer.boxes} boxes of poses`]);
    if (answer.length !== undefined) rows.push(["Length", String(Number(answer.length.toPrecision(8)))]);
    if (answer.proof) rows.push(["Proof", `start is in component ${answer.proof.start_component}, goal in component ${answer.proof.goal_component}`]);
    if (answer.components) {
      rows.push(["Free space", `${answer.components.length} component${answer.components.length === 1 ? "" : "s"}`]);
      const tight = answer.tight ?? [];
      const dimensions = tight.map(({ dimension }) => ["points", "lines", "sheets"][dimension]).join(", ");
      rows.push(["Tight passages", tight.length ? `${tight.length}: ${dimensions}` : "none"]);
    }
    fillOmpl(rows, report);
    rows.push(["Time", `${secondsText(report.op_s)} to compute, ${secondsText(seconds)} until shown`]);
    fillTable(byId("planner-measures"), rows);
    fillPassages(byId("planner-passages"), answer, this.viewer);
    fillNotes(byId("planner-notes"), report.notes);
    this.sets = answer.components ? ["free space", "robot"] : ["robot"];
    this.exportForm.offer(this.sets);
  }

  #showError(text) {
    byId("planner-error").textContent = text;
  }

  #showCommands() {
    const { file, start, goal, free, ompl, seconds } = this.state;
    const moved = Object.keys(this.#movesThatMove()).length > 0 || !file;
    const scene = moved ? "saved-scene.json" : file;
    const ends = [...(start ? ["--start", start.join(",")] : []), ...(goal ? ["--goal", goal.join(",")] : [])];
    const tuple = (numbers) => `(${numbers.map((x) => (/^-?\d+$/.test(x) ? x : JSON.stringify(x))).join(", ")})`;
    const python = (point) => (!point ? "None" : point.length < 7 ? tuple(point) : `(${tuple(point.slice(0, 3))}, ${tuple(point.slice(3))})`);
    showCommands(byId("planner-commands"), [
      ["Command line", [shellLine("planner", scene, ...ends, ...(free ? ["--tight"] : [])),
        ...(ompl ? [shellLine("planner", scene, ...ends, "--ompl", ompl, "--time", String(seconds))] : [])].join("\n")],
      ["Python", `import nef.planner\nscene = nef.planner.read(${JSON.stringify(scene)})\nplan = scene.plan(${python(start)}, ${python(goal)})`],
    ]);
    byId("planner-unsaved").hidden = !moved;
  }

  // The scene with its ends and obstacles where they are now; beside the one that was opened, since it names files.
  async #save() {
    const said = byId("planner-saved");
    try {
      if (!this.scene.text.trimStart().startsWith("{")) throw new Error("a .cfg scene is not written; its ends are on the command line below");
      const json = JSON.parse(spelledNumbers(this.scene.text));
      for (const [number, move] of Object.entries(this.#movesThatMove())) {
        const shape = json.obstacles[number];
        const set = /\(/.test(shape) ? shape : `file(${JSON.stringify(shape)})`;
        json.obstacles[number] = `translate(${set}, ${move.join(",")})`;
      }
      const { start, goal, folder } = this.state;
      const written = (end) => (end.length < 7 ? end : { position: end.slice(0, 3), quaternion: end.slice(3) });
      Object.assign(json, start && { start: written(start) }, goal && { goal: written(goal) });
      const name = `${folder ? `${folder}/` : ""}${byId("planner-save-name").value}.json`;
      await ask("write", { name, text: `${JSON.stringify(json, null, 2)}\n`, overwrite: byId("planner-overwrite").checked });
      said.className = "";
      said.textContent = `${name} written`;
    } catch (error) {
      said.className = "error";
      said.textContent = error.message;
    }
  }

  // What is held at a place of the view: the robot at an end; with the box ticked, the obstacle that is chosen; null
  // elsewhere. It moves in the plane of the two coordinates that the eye looks across, by decimals that are no finer than
  // the screen.
  grab(x, y) {
    const { viewer } = this;
    const wanted = { robot: "start", "robot at the goal": "goal" };
    if (byId("planner-drag").checked) wanted[`obstacle ${this.obstacle}`] = "move";
    // What is behind something else may be meant: obstacles are seen through.
    const hit = viewer.picker.facets(x, y).find(({ layer }) => viewer.views[layer].layer.name in wanted);
    if (!hit) return null;
    const { name } = viewer.views[hit.layer].layer;
    const field = wanted[name];
    if (field !== "move" && !this.#point(field)) return null;
    const before = this.fields[field].map(({ value }) => value || "0");
    const plane = viewer.dragPlane(x, y, hit.depth);
    const begin = plane.at(x, y);
    let moved = false;
    return {
      drag: (toX, toY) => {
        const now = plane.at(toX, toY);
        if (!now) return;
        moved = true;
        const numbers = before.map((number, i) => (i === plane.axis ? number
          : addDecimals(number, decimalNear(now[i] - begin[i], plane.pixel))));
        this.#setPoint(field, field === "move" ? numbers : [...numbers, ...this.#turn(field)]);
        if (field === "move") this.moves[this.obstacle] = numbers;
        const view = viewer.views.find(({ layer }) => layer.name === name);
        if (view && !view.layer.motion) view.moveBy(numbers.map((number, i) => approximately(number) - approximately(before[i])));
        viewer.requestDraw();
        this.#dragged();
      },
      // While it is dragged, any path will do; now a short one is looked for.
      drop: () => moved && this.#edited(0),
    };
  }
}
