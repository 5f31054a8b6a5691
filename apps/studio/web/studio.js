// SPDX-License-Identifier: Apache-2.0
//
// The studio: panels on the left, one viewer on the right, and the state, which the server keeps in a file.
import { Computing } from "./computing.js";
import { ExportForm } from "./export_form.js";
import { HullsPanel } from "./panels/hulls_panel.js";
import { itemDetails } from "./item_details.js";
import { PlannerPanel } from "./panels/planner_panel.js";
import { ask, ServerError, upload } from "./server.js";
import { SetsPanel } from "./panels/sets_panel.js";
import { SumsPanel } from "./panels/sums_panel.js";
import { byId } from "../../view/web/panel.js";
import { Viewer } from "../../view/web/viewer.js";

const KEEP_AFTER = 600; // milliseconds after the last change
const SETS = /\.(nef|nef3|off|obj|stl|ply|glb|3mf)$/i;
const SCENES = /\.(json|cfg)$/i;
const EMPTY_SCENE = { title: "", center: [0, 0, 0], layers: [] };

// The ball around what is to be seen; null if that is nothing.
function ballOf({ focus, center }) {
  if (!focus) return null;
  const [low, high] = focus;
  return { center: low.map((x, i) => (x + high[i]) / 2 + center[i]), radius: Math.hypot(...high.map((x, i) => x - low[i])) / 2 };
}

function isNear(ball, other) {
  const away = Math.hypot(...ball.center.map((x, i) => x - other.center[i]));
  return ball.radius < 1.4 * other.radius && other.radius < 1.4 * ball.radius && away < 0.4 * other.radius;
}

class StudioPage {
  constructor(begin) {
    this.begin = begin;
    this.revision = begin.revision;
    byId("panel").classList.add("folded");
    this.viewer = new Viewer(EMPTY_SCENE);
    this.computing = new Computing({
      onScene: (scene) => this.#showScene(scene),
      onGone: (error) => this.#showGone(error),
    });
    this.exportForm = new ExportForm(begin.language.formats, (error) => this.#showGone(error));
    const shared = { computing: this.computing, exportForm: this.exportForm, language: begin.language,
      viewer: this.viewer, changed: () => this.#keepSoon() };
    this.sets = new SetsPanel(shared);
    this.hulls = new HullsPanel(shared);
    this.planner = new PlannerPanel(shared);
    this.panels = [this.sets, new SumsPanel(shared), this.hulls, this.planner];
    this.viewer.control.grab = (x, y) => this.panel.grab?.(x, y) ?? null;
    this.viewer.details = (item) => itemDetails(this.viewer.page, item).catch((error) => this.#showGone(error));
    this.viewer.onSelect = (item) => this.panel?.selected?.(item);
    byId("root").textContent = begin.root;
    byId("state-file").textContent = begin.state_file;
    this.#takeState(begin.state);
    this.#wire();
  }

  #takeState(text) {
    let state = {};
    try {
      state = text ? JSON.parse(text) : {};
    } catch {
      byId("message").textContent = `${this.begin.state_file} is no state of the studio; it is replaced when you change something`;
    }
    for (const panel of this.panels) if (state[panel.name]) panel.state = state[panel.name];
    this.panel = this.panels.find(({ name }) => name === state.panel) ?? this.panels[0];
    this.kept = this.#stateText();
  }

  #stateText() {
    const states = Object.fromEntries(this.panels.map((panel) => [panel.name, panel.state]));
    return `${JSON.stringify({ nefstudio: 1, panel: this.panel.name, ...states }, null, 2)}\n`;
  }

  async start() {
    await this.refreshFiles();
    const scene = this.begin.files.find((name) => SCENES.test(name));
    const sets = this.begin.files.filter((name) => SETS.test(name));
    if (scene) {
      await this.#openScene(scene);
    } else if (sets.length > 0) {
      this.choose("sets", false);
      await this.sets.use(sets.map((name) => `file(${JSON.stringify(name)})`).join("\n  + "));
    } else {
      this.choose(this.panel.name, true);
    }
  }

  // A scene of cameras is one of hulls.
  async #openScene(name) {
    const { text } = await ask("read", { name });
    const panel = /"(cameras|frames)"\s*:/.test(text) ? this.hulls : this.planner;
    this.choose(panel.name, false);
    await panel.openFile(name);
  }

  #wire() {
    const tabs = [...document.querySelectorAll("#tabs [role=tab]")];
    for (const tab of tabs) {
      tab.addEventListener("click", () => this.choose(tab.dataset.panel, true));
      tab.addEventListener("keydown", (event) => {
        const step = { ArrowRight: 1, ArrowLeft: -1 }[event.key];
        if (!step) return;
        const next = tabs[(tabs.indexOf(tab) + step + tabs.length) % tabs.length];
        next.focus();
        next.click();
      });
    }
    byId("stop").addEventListener("click", async () => {
      if (byId("stop").dataset.sure !== "true") {
        byId("stop").dataset.sure = "true";
        byId("stop").textContent = "Really stop?";
        setTimeout(() => {
          byId("stop").dataset.sure = "false";
          byId("stop").textContent = "Stop";
        }, 3000);
        return;
      }
      await this.#keep();
      await ask("stop").catch(() => {});
      this.#showGone(new Error("The server was stopped. Everything is in " + this.begin.state_file + "."));
    });
    byId("overwrite-state").addEventListener("click", () => this.#keep(true));
    byId("files-refresh").addEventListener("click", () => this.refreshFiles());
    byId("file-insert").addEventListener("click", () => this.sets.addFile(byId("file").value));
    byId("file-pick").addEventListener("change", (event) => this.#takeFiles(event.target.files));
    document.addEventListener("dragover", (event) => event.preventDefault());
    document.addEventListener("drop", (event) => {
      event.preventDefault();
      this.#takeFiles(event.dataTransfer.files);
    });
    window.addEventListener("pagehide", () => this.computing.cancel());
  }

  // Shows a panel, and computes what it says.
  choose(name, compute) {
    this.panel = this.panels.find((panel) => panel.name === name);
    for (const tab of document.querySelectorAll("#tabs [role=tab]")) {
      const chosen = tab.dataset.panel === name;
      tab.setAttribute("aria-selected", String(chosen));
      tab.tabIndex = chosen ? 0 : -1;
      byId(tab.dataset.panel).hidden = !chosen;
    }
    this.exportForm.offer(this.panel.sets);
    byId("export-said").textContent = "";
    this.framed = null;
    if (compute) this.panel.compute();
    this.#keepSoon();
  }

  // The first scene of a panel fills the view; the eye stays for those that follow, unless one is of another size or
  // elsewhere.
  #showScene(scene) {
    this.panel.frame?.(scene);
    this.viewer.show(scene);
    const ball = ballOf(scene);
    if (!this.framed || (ball && !isNear(ball, this.framed))) {
      this.viewer.reset();
      this.framed = ball;
    }
    return this.viewer.pacer.shown();
  }

  async refreshFiles() {
    try {
      const { files } = await ask("files");
      this.hulls.offerFiles(files);
      this.planner.offerFiles(files);
      const sets = files.map(({ name }) => name).filter((name) => SETS.test(name));
      byId("file").replaceChildren(...sets.map((name) => new Option(name, name)));
      byId("file-insert").disabled = sets.length === 0;
    } catch (error) {
      this.#showGone(error);
    }
  }

  async #takeFiles(files) {
    for (const file of files) {
      try {
        const name = await upload(file);
        await this.refreshFiles();
        if (SCENES.test(name)) {
          await this.#openScene(name);
        } else if (SETS.test(name)) {
          if (this.panel !== this.sets) this.choose("sets", false);
          await this.sets.addFile(name);
        }
      } catch (error) {
        if (error instanceof ServerError) byId("message").textContent = error.message;
        else this.#showGone(error);
      }
    }
  }

  #keepSoon() {
    clearTimeout(this.keeping);
    byId("kept").textContent = "";
    this.keeping = setTimeout(() => this.#keep(), KEEP_AFTER);
  }

  async #keep(overwrite = false) {
    clearTimeout(this.keeping);
    const text = this.#stateText();
    if (text === this.kept && !overwrite) {
      byId("kept").textContent = "saved";
      return;
    }
    try {
      const { revision } = await ask("state", { text, revision: this.revision, overwrite });
      this.revision = revision;
      this.kept = text;
      byId("conflict").hidden = true;
      byId("kept").textContent = "saved";
    } catch (error) {
      byId("kept").textContent = "not saved";
      if (error instanceof ServerError) {
        byId("conflict-text").textContent = error.message;
        byId("conflict").hidden = false;
      } else {
        this.#showGone(error);
      }
    }
  }

  #showGone(error) {
    byId("gone").textContent = error.message;
    byId("gone").hidden = false;
  }
}

async function startStudio() {
  try {
    const page = new StudioPage(await ask("start"));
    window.nefStudio = page;
    window.nefViewer = page.viewer;
    byId("message").textContent = "";
    await page.start();
    page.ready = true;
  } catch (error) {
    byId("message").textContent = `The studio cannot be shown: ${error.message}`;
    throw error;
  }
}

startStudio();
