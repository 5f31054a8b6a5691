// SPDX-License-Identifier: Apache-2.0
//
// The computations of a page: one at a time, the last one that was asked for, with how far it is and a button that stops
// it. What is drawn stays until there is something new.
import { ask, computePanel, ServerError } from "./server.js";
import { byId } from "../../view/web/panel.js";

const SHOW_AFTER = 250; // milliseconds before a computation is worth a word
const LOOK_EVERY = 250;

export class Computing {
  // onScene(scene) for every result, which returns a promise that ends when it is on the screen; onGone(error) if the server does not answer.
  constructor({ onScene, onGone }) {
    Object.assign(this, { onScene, onGone });
    this.number = 0;
    this.delayed = null;
    this.running = 0;
    this.waiting = null; // what runs next
    this.picture = null; // the promise of the last result
    byId("cancel").addEventListener("click", () => this.cancel());
  }

  // Runs `work` after so many milliseconds, unless something else is wanted meanwhile.
  soon(work, delay) {
    clearTimeout(this.delayed);
    this.delayed = setTimeout(work, delay);
  }

  // Runs `work` as soon as nothing runs, unless something else is wanted meanwhile: who drags sees each answer rather than
  // none until he rests.
  next(work) {
    clearTimeout(this.delayed);
    if (this.running === 0) work();
    else this.waiting = work;
  }

  // Asks a panel's computation. Returns {report, scene, seconds}, or null if it was cancelled or a newer one has come meanwhile.
  // Throws ServerError.
  async run(panel, request) {
    clearTimeout(this.delayed);
    const me = ++this.number;
    ++this.running;
    this.waiting = null;
    const begin = performance.now();
    byId("progress").dataset.running = "true";
    const showing = setTimeout(() => this.#showProgress(me), SHOW_AFTER);
    try {
      const { report, scene } = await computePanel(panel, request);
      if (me !== this.number) return null;
      const before = this.picture;
      this.picture = this.onScene(scene);
      await before; // who drags gets no more results than pictures
      return { report, scene, seconds: (performance.now() - begin) / 1000 };
    } catch (error) {
      if (error instanceof ServerError) {
        if (error.cancelled || me !== this.number) return null;
        throw error;
      }
      this.onGone(error);
      return null;
    } finally {
      clearTimeout(showing);
      if (me === this.number) {
        byId("progress").hidden = true;
        byId("progress").dataset.running = "false";
      }
      --this.running;
      const work = this.waiting;
      if (work && this.running === 0) {
        this.waiting = null;
        work();
      }
    }
  }

  async cancel() {
    this.waiting = null;
    try {
      await ask("cancel");
    } catch (error) {
      this.onGone(error);
    }
  }

  async #showProgress(me) {
    while (me === this.number && byId("progress").dataset.running === "true") {
      let state;
      try {
        state = await ask("progress");
      } catch {
        return; // the computation itself tells
      }
      if (me !== this.number || byId("progress").dataset.running !== "true") return;
      const bar = byId("progress-bar");
      if (state.total > 0) bar.value = state.done / state.total;
      else bar.removeAttribute("value");
      byId("progress-text").textContent = state.running ? `${state.phase || "computing"}, ${state.seconds.toFixed(1)} s` : "";
      byId("progress").hidden = false;
      await new Promise((done) => setTimeout(done, LOOK_EVERY));
    }
  }
}
