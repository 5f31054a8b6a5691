// SPDX-License-Identifier: Apache-2.0
//
// The command line and the Python that do the same as a panel.

// A word for a shell.
export const shellWord = (text) => (/^[\w./:,=+-]+$/.test(text) ? text : `'${String(text).replaceAll("'", "'\\''")}'`);

export const shellLine = (...words) => words.map(shellWord).join(" ");

// A literal of Python.
export const pythonText = (text) => JSON.stringify(String(text));

// A number of Python that is the same: whole ones as they are, others as fractions of their text.
export const pythonNumber = (text) => (/^-?\d+$/.test(text) ? text : `Fraction(${pythonText(text)})`);

// Shows both in an element made for it, each with a button that copies it.
export function showCommands(element, commands) {
  const same = element.dataset.shown === JSON.stringify(commands);
  if (same) return;
  element.dataset.shown = JSON.stringify(commands);
  element.replaceChildren(...commands.map(([name, text]) => {
    const block = document.createElement("div");
    block.className = "command";
    const code = Object.assign(document.createElement("pre"), { textContent: text, tabIndex: 0 });
    code.setAttribute("aria-label", name);
    const copy = Object.assign(document.createElement("button"), { type: "button", textContent: "Copy" });
    copy.setAttribute("aria-label", `Copy: ${name}`);
    copy.addEventListener("click", async () => {
      await navigator.clipboard.writeText(text);
      copy.textContent = "Copied";
      setTimeout(() => (copy.textContent = "Copy"), 1500);
    });
    const title = Object.assign(document.createElement("h3"), { textContent: name });
    block.append(title, copy, code);
    return block;
  }));
}
