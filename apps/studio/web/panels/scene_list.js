// SPDX-License-Identifier: Apache-2.0
//
// The list of files that may be scenes, in the panels that open one.

/** Offers the JSON files among `files` in a select, which keeps what was chosen; `button` opens it. */
export function offerScenes(select, button, files) {
  const before = select.value;
  const scenes = files.map(({ name }) => name).filter((name) => name.endsWith(".json"));
  select.replaceChildren(...scenes.map((name) => new Option(name, name)));
  if (scenes.includes(before)) select.value = before;
  button.disabled = scenes.length === 0;
}
