// SPDX-License-Identifier: Apache-2.0
//
// Decimal numbers as they are written, without rounding: what a drag or a key adds to one.

const DECIMAL = /^([+-]?)(\d*)(?:\.(\d*))?$/;

// [all digits as a BigInt, how many of them stand behind the point]; null for what is no decimal number.
function digitsOf(text) {
  const match = DECIMAL.exec(text.trim());
  if (!match || !(match[2] || match[3])) return null;
  const behind = match[3] ?? "";
  const all = BigInt((match[2] || "0") + behind);
  return [match[1] === "-" ? -all : all, behind.length];
}

function written(all, places) {
  const digits = (all < 0n ? -all : all).toString().padStart(places + 1, "0");
  const before = digits.slice(0, digits.length - places);
  const behind = digits.slice(digits.length - places).replace(/0+$/, "");
  return `${all < 0n ? "-" : ""}${before}${behind ? `.${behind}` : ""}`;
}

// The value of a number p, p/q or a decimal, for the eye.
export function approximately(text) {
  const [above, below = "1"] = String(text).split("/");
  return Number(above) / Number(below);
}

// a + b for decimals, exactly; if one of them is a fraction, the nearest decimal of a few places instead.
export function addDecimals(a, b) {
  const [x, y] = [digitsOf(a), digitsOf(b)];
  if (!x || !y) return String(Number((approximately(a) + approximately(b)).toFixed(6)));
  const places = Math.max(x[1], y[1]);
  const scaled = ([all, own]) => all * 10n ** BigInt(places - own);
  return written(scaled(x) + scaled(y), places);
}

// The decimal of so few places that it is next to a number on a screen where a pixel is worth `pixel`.
export function decimalNear(value, pixel) {
  const places = Math.min(12, Math.max(0, Math.ceil(-Math.log10(pixel))));
  return addDecimals(value.toFixed(places), "0");
}

// The number before or behind a place of a text with its last digit one higher (or lower), and where it stands: what the
// keys Alt and up or down do. Null if there is none.
export function stepNumber(text, at, up) {
  let begin = at;
  while (begin > 0 && /[\d.]/.test(text[begin - 1])) --begin;
  let end = at;
  while (end < text.length && /[\d.]/.test(text[end])) ++end;
  if (begin === end || /[A-Za-z_]/.test(text[begin - 1] ?? "")) return null;
  // A sign belongs to a number behind '(' ',' '[' '=' or another sign.
  if (text[begin - 1] === "-" && /[(,[=]\s*$/.test(text.slice(0, begin - 1))) --begin;
  const number = text.slice(begin, end);
  const digits = digitsOf(number);
  if (!digits) return null;
  const step = digits[1] === 0 ? "1" : `0.${"0".repeat(digits[1] - 1)}1`;
  return { begin, end, number: addDecimals(number, up ? step : `-${step}`) };
}
