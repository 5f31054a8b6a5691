// SPDX-License-Identifier: Apache-2.0
//
// An editor for expressions: a text area, under which the same text lies in colours, with what is wrong underlined and
// the error below, and a list of words that the one at the cursor may become.
import { stepNumber } from "./exact.js";

const TOKENS = /(#[^\n]*)|("[^"\n]*"?)|((?:\d+\.?\d*|\.\d+)(?:e[+-]?\d+)?)|([A-Za-z_][A-Za-z_0-9]*)|([-+*^!])/g;

const textNode = (text) => document.createTextNode(text);

function spanOf(className, text) {
  const span = document.createElement("span");
  span.className = className;
  span.textContent = text;
  return span;
}

// Characters of a text before `bytes` bytes of UTF-8.
function charactersOf(text, bytes) {
  return new TextDecoder().decode(new TextEncoder().encode(text).slice(0, bytes)).length;
}

export class ExpressionEditor {
  // functions: [{name, usage}]; onChange(text) after every change by the user.
  constructor(root, { label, functions, onChange }) {
    Object.assign(this, { root, functions, onChange });
    this.known = new Set(functions.map(({ name }) => name));
    root.classList.add("editor");
    this.colors = document.createElement("pre");
    this.colors.setAttribute("aria-hidden", "true");
    this.area = document.createElement("textarea");
    Object.assign(this.area, { spellcheck: false, autocapitalize: "off", autocomplete: "off" });
    this.area.setAttribute("aria-label", label);
    this.words = document.createElement("ul");
    this.words.className = "words";
    this.words.setAttribute("role", "listbox");
    this.words.hidden = true;
    this.error = document.createElement("p");
    this.error.className = "error";
    this.error.setAttribute("role", "alert");
    const box = document.createElement("div");
    box.className = "box";
    box.append(this.colors, this.area, this.words);
    root.append(box, this.error);
    this.area.addEventListener("input", () => {
      this.#changed();
      this.#offerWords();
    });
    this.area.addEventListener("scroll", () => this.#scroll());
    this.area.addEventListener("keydown", (event) => this.#key(event));
    this.area.addEventListener("blur", () => (this.words.hidden = true));
    this.mark = null;
  }

  get text() {
    return this.area.value;
  }

  // Without telling onChange.
  set text(text) {
    this.area.value = text;
    this.#show(null);
  }

  // Other text in a range of it, without telling onChange; the cursor is put before it.
  replace(begin, end, text) {
    this.area.setRangeText(text, begin, end, "start");
    this.area.setSelectionRange(begin, begin);
    this.mark = null;
    this.#paint();
  }

  // {offset, message} or null.
  showError(error) {
    if (error || this.error.textContent) this.#show(error); // else it is painted already
  }

  #show(error) {
    this.mark = error ? charactersOf(this.text, error.offset) : null;
    this.error.textContent = error ? error.message : "";
    this.area.setAttribute("aria-invalid", String(Boolean(error)));
    this.#paint();
  }

  // Puts a text where the cursor is, in place of what is selected.
  insert(text) {
    const { selectionStart, selectionEnd } = this.area;
    this.area.setRangeText(text, selectionStart, selectionEnd, "end");
    this.area.focus();
    this.#changed();
  }

  #changed() {
    this.mark = null;
    this.#paint();
    this.onChange(this.text);
  }

  // What is wrong is underlined to the end of its word, or for one character.
  #paint() {
    const { text } = this;
    const parts = [];
    let at = 0;
    const plain = (end) => {
      if (end > at) parts.push([at, end, ""]);
      at = end;
    };
    for (const match of text.matchAll(TOKENS)) {
      plain(match.index);
      const kind = ["comment", "string", "number", "name", "operator"][match.slice(1).findIndex((found) => found !== undefined)];
      at += match[0].length;
      parts.push([match.index, at, kind === "name" ? (this.known.has(match[0]) ? "function" : "variable") : kind]);
    }
    plain(text.length);
    const nodes = parts.map(([begin, end, kind]) => {
      const wrong = this.mark !== null && begin <= this.mark && this.mark < end;
      const part = text.slice(begin, end);
      if (!wrong) return kind ? spanOf(kind, part) : textNode(part);
      if (kind) return spanOf(`${kind} wrong`, part);
      const inside = this.mark - begin;
      const span = document.createElement("span");
      span.append(part.slice(0, inside), spanOf("wrong", part.slice(inside, inside + 1)), part.slice(inside + 1));
      return span;
    });
    const atEnd = this.mark !== null && this.mark >= text.length;
    this.colors.replaceChildren(...nodes, ...(atEnd ? [spanOf("wrong", " ")] : []), textNode("\n"));
    this.#scroll();
  }

  #scroll() {
    this.colors.scrollTop = this.area.scrollTop;
    this.colors.scrollLeft = this.area.scrollLeft;
  }

  #wordBegin() {
    return /[A-Za-z_][A-Za-z_0-9]*$/.exec(this.text.slice(0, this.area.selectionStart))?.index ?? -1;
  }

  // From the first letter on, and all of them where somebody asks for them with Ctrl and space.
  #offerWords(all = false) {
    const begin = this.#wordBegin();
    const typed = begin < 0 ? "" : this.text.slice(begin, this.area.selectionStart);
    const own = [...this.text.matchAll(/(?:^|;)\s*([A-Za-z_]\w*)\s*=/g)].map(([, name]) => ({ name, usage: name }));
    const found = typed || all
      ? [...own, ...this.functions].filter(({ name }) => name.startsWith(typed) && name !== typed) : [];
    this.words.hidden = found.length === 0;
    this.words.replaceChildren(...found.slice(0, 8).map(({ name, usage }, i) => {
      const item = document.createElement("li");
      item.setAttribute("role", "option");
      item.dataset.name = name;
      item.append(spanOf("usage", usage));
      item.addEventListener("pointerdown", (event) => {
        event.preventDefault(); // the text area keeps the focus
        this.#choose(i);
        this.#take();
      });
      return item;
    }));
    this.#choose(0);
  }

  #choose(index) {
    const items = [...this.words.children];
    if (items.length === 0) return;
    this.chosen = (index + items.length) % items.length;
    items.forEach((item, i) => item.setAttribute("aria-selected", String(i === this.chosen)));
  }

  #take() {
    const { name } = this.words.children[this.chosen].dataset;
    const bare = !this.known.has(name) || name === "everything" || name === "nothing";
    const begin = this.#wordBegin();
    const end = this.area.selectionStart;
    this.area.setRangeText(bare ? name : `${name}(`, begin < 0 ? end : begin, end, "end");
    this.words.hidden = true;
    this.#changed();
  }

  #key(event) {
    if (!this.words.hidden) {
      const step = { ArrowDown: 1, ArrowUp: -1 }[event.key];
      if (step && !event.altKey) this.#choose(this.chosen + step);
      else if (event.key === "Tab" || event.key === "Enter") this.#take();
      else if (event.key === "Escape") this.words.hidden = true;
      else return;
      event.preventDefault();
    } else if (event.key === " " && event.ctrlKey) {
      event.preventDefault();
      this.#offerWords(true);
    } else if (event.altKey && (event.key === "ArrowUp" || event.key === "ArrowDown")) {
      const stepped = stepNumber(this.text, this.area.selectionStart, event.key === "ArrowUp");
      if (!stepped) return;
      event.preventDefault();
      this.area.setRangeText(stepped.number, stepped.begin, stepped.end, "select");
      this.area.setSelectionRange(stepped.begin + stepped.number.length, stepped.begin + stepped.number.length);
      this.#changed();
    }
  }
}
