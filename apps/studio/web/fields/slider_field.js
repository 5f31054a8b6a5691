// SPDX-License-Identifier: Apache-2.0
//
// A slider beside a field of the same number.
import { byId } from "../../../view/web/panel.js";
import { approximately } from "../exact.js";

// Each of the two follows the other one. typed() is called when the field was changed, slid() when the slider was.
export class SliderField {
  constructor(field, slider, { typed, slid }) {
    this.field = byId(field);
    this.slider = byId(slider);
    this.field.addEventListener("input", () => {
      this.#follow();
      typed();
    });
    this.slider.addEventListener("input", () => {
      this.field.value = this.slider.value;
      slid();
    });
  }

  get value() {
    return this.field.value.trim();
  }

  // Without a call.
  set value(text) {
    this.field.value = text;
    this.#follow();
  }

  // What is no number (a name, nothing) is the slider's zero.
  #follow() {
    this.slider.value = approximately(this.value) || 0;
  }
}
