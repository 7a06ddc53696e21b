// The page of a study.

import {ErrorChart} from './charts.js';
import {element} from './dom.js';
import {digits} from './format.js';

/** Rows of a CSV file whose fields may be quoted. */
function parse(csv) {
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

function cell(name, text) {
  if (name.startsWith('error') && text !== '' && Number.isFinite(Number(text))) return `${digits(100 * Number(text), 3)} %`;
  if (name === 'front') return text === '1' ? '★' : '';
  return text !== '' && Number.isFinite(Number(text)) ? digits(Number(text), 4) : text.replace(/^(nan|-nan)$/, '');
}

/** Columns where something stands. A click on a title sorts by it. */
function table(csv) {
  const [names, ...rows] = parse(csv);
  const kept = names.map((_, c) => c).filter((c) => rows.some((row) => !['', 'nan', '-nan'].includes(row[c])));
  const body = element('tbody');
  const fill = (list) => body.replaceChildren(...list.map((row) => element('tr', {class: /^(failed|refused)/.test(row.at(-1)) ? 'bad' : ''},
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

export function showStudy(data, page) {
  document.title = `Study ${data.name} – Supple`;
  const charts = data.cases ? [] : [new ErrorChart('Error against run time', 'run time in s', data.rows, 'seconds'),
    new ErrorChart(`Error against ${data.by_step ? 'step' : 'size of the cells'}`, data.by_step ? 'mean step in s' : 'size of the cells in m', data.rows, 'size')];
  const soonest = data.cases || data.sentences.length === 0 ? null
    : element('section', {class: 'group'}, element('h2', {}, 'Soonest at an error of'), element('ul', {}, data.sentences.map((text) => element('li', {}, text))));
  page.replaceChildren(element('header', {}, element('h1', {}, data.name, element('span', {class: 'state'}, 'study'))),
    element('ul', {class: 'study-facts'}, data.facts.map((fact) => element('li', {}, fact.replaceAll('`', '')))),
    element('div', {class: 'columns even'}, charts.map((chart) => chart.root)), soonest,
    element('section', {}, element('h2', {}, 'Runs'), table(data.csv)),
    element('section', {class: 'about'}, element('p', {}, '★: no other run is both better and quicker. Order: observed, from the row before of the same series.'),
      element('p', {}, `Written by Supple ${data.version}. It needs no network.`)));
  charts.filter((chart) => chart.rows.length > 0).forEach((chart) => chart.draw());
  charts.filter((chart) => chart.rows.length === 0).forEach((chart) => chart.root.remove());
}
