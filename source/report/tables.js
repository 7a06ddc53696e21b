// Tables that a click on a title sorts.

import {element} from './dom.js';

/** Rows of a CSV file whose fields may be quoted. */
export function parse(csv) {
  const rows = [[]];
  let field = '', quoted = false;
  for (let i = 0; i < csv.length; ++i) {
    const c = csv[i];
    if (quoted) {
      if (c === '"' && csv[i + 1] === '"') { field += '"'; ++i; }
      else if (c === '"') quoted = false;
      else field += c;
    } else if (c === '"') quoted = true;
    else if (c === ',' || c === '\n') {
      rows.at(-1).push(field);
      field = '';
      if (c === '\n') rows.push([]);
    } else field += c;
  }
  return rows.filter((row) => row.length > 1);
}

/**
 * Columns where something stands.
 * @param cell what is shown of a column's name and a field
 * @param bad  whether a row stands out
 */
export function sortableTable(csv, cell, bad = () => false) {
  const [names, ...rows] = parse(csv);
  const kept = names.map((_, c) => c).filter((c) => rows.some((row) => !['', 'nan', '-nan'].includes(row[c])));
  const body = element('tbody');
  const fill = (list) => body.replaceChildren(...list.map((row) => element('tr', {class: bad(row) ? 'bad' : ''},
    kept.map((c) => element('td', {class: Number.isFinite(Number(row[c] || 'x')) ? 'number' : ''}, cell(names[c], row[c]))))));
  let sorted = null;
  const sort = (c) => {
    sorted = sorted === c ? null : c;
    const compare = (a, b) => (Number(a[c]) - Number(b[c])) || a[c].localeCompare(b[c]);
    fill(sorted === null ? rows : [...rows].sort(compare));
  };
  fill(rows);
  return element('div', {class: 'wide'}, element('table', {class: 'study'},
    element('thead', {}, element('tr', {}, kept.map((c) => element('th', {scope: 'col'},
      element('button', {type: 'button', title: 'Sort; once more: as they were run', onclick: () => sort(c)}, names[c].replaceAll('_', ' ')))))), body));
}
