// The page of a study.

import {ErrorChart} from './charts.js';
import {element} from './dom.js';
import {digits} from './format.js';
import {sortableTable} from './tables.js';

function cell(name, text) {
  if (name.startsWith('error') && text !== '' && Number.isFinite(Number(text))) return `${digits(100 * Number(text), 3)} %`;
  if (name === 'front') return text === '1' ? '★' : '';
  return text !== '' && Number.isFinite(Number(text)) ? digits(Number(text), 4) : text.replace(/^(nan|-nan)$/, '');
}

const bad = (row) => /^(failed|refused)/.test(row.at(-1));

export function showStudy(data, page) {
  document.title = `Study ${data.name} – Supple`;
  const charts = data.cases ? [] : [new ErrorChart('Error against run time', 'run time in s', data.rows, 'seconds'),
    new ErrorChart(`Error against ${data.by_step ? 'step' : 'size of the cells'}`, data.by_step ? 'mean step in s' : 'size of the cells in m', data.rows, 'size')];
  const soonest = data.cases || data.sentences.length === 0 ? null
    : element('section', {class: 'group'}, element('h2', {}, 'Soonest at an error of'), element('ul', {}, data.sentences.map((text) => element('li', {}, text))));
  page.replaceChildren(element('header', {}, element('h1', {}, data.name, element('span', {class: 'state'}, 'study'))),
    element('ul', {class: 'study-facts'}, data.facts.map((fact) => element('li', {}, fact.replaceAll('`', '')))),
    element('div', {class: 'columns even'}, charts.map((chart) => chart.root)), soonest,
    element('section', {}, element('h2', {}, 'Runs'), sortableTable(data.csv, cell, bad)),
    element('section', {class: 'about'}, element('p', {}, '★: no other run is both better and quicker. Order: observed, from the row before of the same series.'),
      element('p', {}, `Written by Supple ${data.version}. It needs no network.`)));
  charts.filter((chart) => chart.rows.length > 0).forEach((chart) => chart.draw());
  charts.filter((chart) => chart.rows.length === 0).forEach((chart) => chart.root.remove());
}
