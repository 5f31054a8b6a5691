// SPDX-License-Identifier: Apache-2.0
//
// The measures of a set, as `nef info --json` has them, for people.

const rounded = (value) => Number(Number(value).toPrecision(8));

// An exact number if it is short, else a double with the bound of its error.
function measureText(exact, value, error) {
  if (exact !== null && exact !== undefined && typeof exact === "string") {
    const isShort = exact.length <= 24;
    if (isShort) return exact.includes("/") ? `${exact} \u2248 ${rounded(value)}` : exact;
    return `\u2248 ${rounded(value)}`;
  }
  if (value === null || value === undefined) return "infinite";
  return error ? `${rounded(value)} \u00b1 ${Number(error).toPrecision(1)}` : String(rounded(value));
}

export const areaText = (info) => measureText(null, info.area, info.area_error);

export function measureRows(info) {
  const yes = (name) => (info[name] ? name : `not ${name}`);
  const rows = [];
  if (info.volume !== undefined || info.volume_double !== undefined) {
    rows.push(["Volume", measureText(info.volume, info.volume_double, info.volume_error)]);
  }
  if (info.area !== undefined) rows.push(["Area", areaText(info)]);
  const counts = ["vertices", "edges", "facets", "volumes"].filter((name) => info[name] !== undefined);
  if (info.tiles) rows.push(["In tiles", `${info.tiles}, ${info.triangles} triangles`]);
  else rows.push(["Items", counts.map((name) => `${info[name]} ${name}`).join(", ")]);
  const properties = ["closed", "open", "bounded", "regular", "convex"].filter((name) => typeof info[name] === "boolean");
  if (properties.length > 0) rows.push(["It is", properties.map(yes).join(", ")]);
  return rows;
}

// A table of rows [name, text].
export function fillTable(table, rows) {
  table.replaceChildren(...rows.map(([name, text]) => {
    const row = document.createElement("tr");
    const head = Object.assign(document.createElement("th"), { textContent: name, scope: "row" });
    row.append(head, Object.assign(document.createElement("td"), { textContent: text }));
    return row;
  }));
}

// Lines of notes under a result.
export function fillNotes(list, notes) {
  list.replaceChildren(...(notes ?? []).map((note) => Object.assign(document.createElement("li"), { textContent: note })));
  list.hidden = !(notes?.length > 0);
}

export const secondsText = (seconds) => (seconds < 0.1 ? `${(1000 * seconds).toFixed(1)} ms` : `${seconds.toFixed(2)} s`);
