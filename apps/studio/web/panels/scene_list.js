// SPDX-License-Identifier: Apache-2.0
//
// The list of files that may be scenes, in the panels that open one.

/** Offers those of `files` that end so in a select, which keeps what was chosen; `button` opens it. */
export function offerScenes(select, button, files, endings) {
  const before = select.value;
  const scenes = files.map(({ name }) => name).filter((name) => endings.some((ending) => name.endsWith(ending)));
  select.replaceChildren(...scenes.map((name) => new Option(name, name)));
  if (scenes.includes(before)) select.value = before;
  button.disabled = scenes.length === 0;
}
