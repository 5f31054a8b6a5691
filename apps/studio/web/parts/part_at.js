// SPDX-License-Identifier: Apache-2.0
//
// The parts of an expression as pieces of its text: which one is at a place, and texts that move, turn and scale it. All
// numbers are decimals that are computed exactly.
import { addDecimals } from "../exact.js";

const PART_TOKENS = /#[^\n]*|"[^"\n]*"?|[A-Za-z_]\w*(?=\s*\()|[([]|[)\]]|[,;]/g;
const DECIMAL_ONLY = /^[+-]?(\d+\.?\d*|\.\d+)$/;
const NO_MOVE = ["0", "0", "0"];

// The innermost call of a function around a place: {begin, end}; null if there is none.
export function partAt(text, at) {
  const open = []; // begins of calls, or -1 for other parentheses
  let name = -1;
  let best = null;
  for (const match of text.matchAll(PART_TOKENS)) {
    const [token] = match;
    if (/^\w/.test(token)) {
      name = match.index;
      continue;
    }
    if (token === "(" || token === "[") open.push(name);
    if (token === ")" || token === "]") {
      const begin = open.pop() ?? -1;
      const end = match.index + 1;
      if (begin >= 0 && begin <= at && at <= end && !(best && best.begin >= begin)) best = { begin, end };
    }
    name = -1;
  }
  return best;
}

// What a part of a text means by itself: with the definitions before it.
export function withDefinitions(text, { begin, end }) {
  let depth = 0;
  let defined = 0;
  for (const match of text.slice(0, begin).matchAll(PART_TOKENS)) {
    const [token] = match;
    if (token === "(" || token === "[") ++depth;
    else if (token === ")" || token === "]") --depth;
    else if (token === ";" && depth === 0) defined = match.index + 1;
  }
  return `${text.slice(0, defined)}\n${text.slice(begin, end)}`;
}

// {name, args} of a text that is one call.
function callOf(part) {
  const name = /^[A-Za-z_]\w*/.exec(part)?.[0] ?? "";
  const args = [];
  let depth = 0;
  let begin = part.indexOf("(") + 1;
  for (const match of part.matchAll(PART_TOKENS)) {
    const [token] = match;
    if (token === "(" || token === "[") ++depth;
    if (token === ")" || token === "]") --depth;
    if ((token === "," && depth === 1) || (depth === 0 && (token === ")" || token === "]"))) {
      args.push(part.slice(begin, match.index).trim());
      begin = match.index + 1;
    }
  }
  return { name, args };
}

const negated = (number) => addDecimals("0", number.startsWith("-") ? number.slice(1) : `-${number}`);

// The set and the numbers of a translation by decimals; others are none.
function translationOf(part) {
  const { name, args } = callOf(part);
  const numbers = args.slice(1).map((argument) => argument.replaceAll(/\s/g, ""));
  const plain = name === "translate" && args.length === 4 && numbers.every((number) => DECIMAL_ONLY.test(number));
  return plain ? { inside: args[0], by: numbers } : { inside: part, by: NO_MOVE };
}

const isNoMove = (by) => by.every((number) => addDecimals(number, "0") === "0");

// The part moved by three decimals. One that is moved already gets other numbers.
export function movedPart(part, by) {
  const before = translationOf(part);
  const all = by.map((number, i) => addDecimals(before.by[i], number));
  return isNoMove(all) ? before.inside : `translate(${before.inside}, ${all.join(",")})`;
}

// What is done about a point: change(part) is done about the origin.
const about = (part, point, change) => movedPart(change(movedPart(part, point.map(negated))), point);

// The part turned about an axis through a point, by a number of degrees. One that was turned so before is turned more.
export function turnedPart(part, axis, degrees, point) {
  const outer = translationOf(part);
  const turn = callOf(outer.inside);
  if (turn.name === "rotate" && turn.args.length === 3 && turn.args[1] === axis && DECIMAL_ONLY.test(turn.args[2])) {
    const before = translationOf(turn.args[0]);
    const back = movedPart(before.inside, before.by);
    if (back === turn.args[0] && outer.by.every((number, i) => addDecimals(number, before.by[i]) === "0")) {
      return movedPart(`rotate(${turn.args[0]}, ${axis}, ${addDecimals(turn.args[2], degrees)})`, outer.by);
    }
  }
  return about(part, point, (one) => `rotate(${one}, ${axis}, ${degrees})`);
}

// The part scaled by a decimal about a point.
export const scaledPart = (part, factor, point) => about(part, point, (one) => `scale(${one}, ${factor})`);
