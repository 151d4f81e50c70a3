// SPDX-FileCopyrightText: 2026 The Rakelight authors
// SPDX-License-Identifier: GPL-3.0-or-later
//
// What all scripts of the page build with: its data, elements, numbers, tables. Texts of the stack become text nodes, never
// markup.

const result = JSON.parse(document.getElementById('result').textContent);
const data = JSON.parse(document.getElementById('data').textContent);
const byId = (id) => document.getElementById(id);

/** An element with attributes and children; strings become text. */
function element(name, attributes = {}, ...children) {
  const made = document.createElement(name);
  for (const [key, value] of Object.entries(attributes)) made.setAttribute(key, value);
  made.append(...children);
  return made;
}

/** A number for people: three digits, a dash where there is none. */
function short(value) {
  if (value === null || value === undefined) return '\u2013';
  if (typeof value !== 'number') return String(value);
  return String(Number(value.toPrecision(3)));
}

/** Rows [heading, cell, ...] as a table body, the first cell of each a heading. */
function fillTable(table, rows, headings = []) {
  if (headings.length) {
    table.append(element('thead', {}, element('tr', {}, ...headings.map((text) => element('th', {scope: 'col'}, text)))));
  }
  table.append(element('tbody', {}, ...rows.map(([heading, ...cells]) => element('tr', {},
    element('th', {scope: 'row'}, heading), ...cells.map((cell) => element('td', {}, short(cell)))))));
}

/** An SVG element; strings become text. */
function svg(name, attributes = {}, ...children) {
  const made = document.createElementNS('http://www.w3.org/2000/svg', name);
  for (const [key, value] of Object.entries(attributes)) made.setAttribute(key, value);
  made.append(...children);
  return made;
}
