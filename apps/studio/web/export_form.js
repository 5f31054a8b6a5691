// SPDX-License-Identifier: Apache-2.0
//
// Writes a set of the last computation to a file below the root.
import { ask } from "./server.js";
import { byId } from "../../view/web/panel.js";

export class ExportForm {
  constructor(formats, onGone) {
    this.form = byId("export");
    byId("export-format").replaceChildren(...formats.map((format) => new Option(format, format)));
    this.form.addEventListener("submit", async (event) => {
      event.preventDefault();
      await this.#write(onGone);
    });
  }

  // The names of the sets that can be written.
  offer(sets) {
    const select = byId("export-set");
    const before = select.value;
    select.replaceChildren(...sets.map((name) => new Option(name, name)));
    if (sets.includes(before)) select.value = before;
    byId("export-set-label").hidden = sets.length < 2;
    this.form.hidden = sets.length === 0;
  }

  async #write(onGone) {
    const said = byId("export-said");
    said.className = "";
    said.textContent = "Writing";
    try {
      const { name, bytes, notes } = await ask("export", {
        set: byId("export-set").value,
        name: `${byId("export-name").value}.${byId("export-format").value}`,
        exact: byId("export-exact").checked,
        overwrite: byId("export-overwrite").checked,
      });
      said.textContent = [`${name}: ${bytes} bytes written`, ...notes].join("\n");
    } catch (error) {
      said.className = "error";
      said.textContent = error.message;
      if (error.status === undefined) onGone(error);
    }
  }
}
