// SPDX-License-Identifier: Apache-2.0
//
// Moves, turns and scales the part of an expression at the cursor, by handles in the view or by numbers.
import { decimalNear } from "../exact.js";
import { byId } from "../../../view/web/panel.js";
import { Gizmo } from "./gizmo.js";
import { movedPart, partAt, scaledPart, turnedPart, withDefinitions } from "./part_at.js";

const PART_AXES = ["x", "y", "z"];

export class PartMover {
  // editor: of the expression; onChange(dragged) after each change of its text, onPart() when another part is looked at.
  constructor({ editor, viewer, onChange, onPart }) {
    Object.assign(this, { editor, viewer, onChange, onPart });
    this.gizmo = new Gizmo(viewer);
    this.part = null; // {begin, end} in the text
    this.box = null; // of the part, as the server says
    byId("parts-on").addEventListener("change", () => this.#look(true));
    for (const event of ["keyup", "pointerup"]) editor.area.addEventListener(event, () => this.#look(false));
    for (const kind of ["move", "turn", "scale"]) {
      byId(`parts-${kind}`).addEventListener("click", () => this.#byNumber(kind));
    }
  }

  get on() {
    return byId("parts-on").checked;
  }

  // What is asked of the server besides the set: the text of the part; null if there is none.
  get wanted() {
    return this.on && this.part ? withDefinitions(this.editor.text, this.part) : null;
  }

  // Another text has come.
  forget() {
    this.part = null;
    this.box = null;
    this.gizmo.hide();
    this.#say();
  }

  // The box of the part that was wanted; null if it has none.
  found(box) {
    this.box = this.on && this.part ? box : null;
    if (!this.held) this.gizmo.show(this.box);
    this.#say();
  }

  #look(always) {
    if (!this.on) {
      if (always) this.forget();
      return;
    }
    const part = partAt(this.editor.text, this.editor.area.selectionStart);
    const same = part && this.part && part.begin === this.part.begin && part.end === this.part.end;
    if (same && !always) return;
    this.part = part;
    if (!part) this.forget();
    this.#say();
    if (part) this.onPart();
  }

  #say() {
    const text = this.part ? this.editor.text.slice(this.part.begin, this.part.end) : "";
    byId("parts-name").textContent = !this.on ? "" : text ? text.slice(0, 70) : "Put the cursor into a shape of the text.";
    for (const kind of ["move", "turn", "scale"]) byId(`parts-${kind}`).disabled = !this.box;
  }

  // The middle of the part in few decimals, which it is turned about and scaled from.
  #middle() {
    const [low, high] = this.box;
    const size = Math.max(...high.map((x, i) => x - low[i])) || 1;
    return low.map((x, i) => decimalNear((x + high[i]) / 2, size / 1000));
  }

  // The text of a part after a change {kind, axis, by}.
  #changed(text, { kind, axis, by }, middle) {
    if (kind === "move") return movedPart(text, PART_AXES.map((name) => (name === axis ? by : "0")));
    return kind === "turn" ? turnedPart(text, axis, by, middle) : scaledPart(text, by, middle);
  }

  #replace(part, text) {
    this.part = { begin: part.begin, end: part.begin + text.length };
    this.editor.replace(part.begin, part.end, text);
  }

  #byNumber(kind) {
    if (!this.box) return;
    const by = byId("parts-by").value.trim();
    const usable = /^[+-]?(\d+\.?\d*|\.\d+)$/.test(by) && !(kind === "scale" && Number(by) === 0);
    byId("parts-by").setAttribute("aria-invalid", String(!usable));
    if (!usable) return;
    const { begin, end } = this.part;
    const text = this.editor.text.slice(begin, end);
    this.#replace(this.part, this.#changed(text, { kind, axis: byId("parts-axis").value, by }, this.#middle()));
    this.#say();
    this.onChange(false);
  }

  grab(x, y) {
    const handle = this.box ? this.gizmo.handleAt(x, y) : null;
    if (!handle) return null;
    const text = this.editor.text.slice(this.part.begin, this.part.end);
    const middle = this.#middle();
    this.held = true;
    let moved = false;
    return {
      drag: (toX, toY) => {
        const change = this.gizmo.dragged(handle, [x, y], [toX, toY]);
        moved = true;
        this.#replace(this.part, change.by === "0" ? text : this.#changed(text, change, middle));
        this.gizmo.follow(change);
        this.onChange(true);
      },
      drop: () => {
        this.held = false;
        if (moved) this.onChange(false);
      },
    };
  }
}
