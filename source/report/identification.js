// The page of an identification: which thickness and elasticity ratio of two layers fit to measured surfaces.

import {ProfileChart} from './charts.js';
import {colourAt, ERRORS} from './colours.js';
import {choice, element} from './dom.js';
import {digits} from './format.js';
import {parse, sortableTable} from './tables.js';

/** Errors are small beside the lengths: in the next smaller unit. */
const smaller = {mm: ['µm', 1000], m: ['mm', 1000]};

/** Dark colours carry white numbers. */
function cellStyle(part) {
  const rgb = colourAt(ERRORS, part);
  const light = 0.3 * rgb[0] + 0.59 * rgb[1] + 0.11 * rgb[2] > 0.5;
  return `background: rgb(${rgb.map((c) => Math.round(255 * c)).join(' ')}); color: ${light ? '#111' : '#fff'}`;
}

/** A row for each thickness, a column for each ratio, coloured by the logarithm of the error. */
class HeatMap {
  constructor(data) {
    const [names, ...rows] = parse(data.csv);
    this.names = names;
    this.rows = rows.map((row) => row.map(Number));
    this.unit = data.unit;
    this.holder = element('div', {class: 'wide'});
    const sets = data.sets.map((set) => [`error_${set}`, `set ${set}`]);
    const maps = data.sets.length > 1 ? [['root_of_squares', 'all sets, root of squares'], ['sum', 'all sets, sum'], ['maximum', 'all sets, maximum'], ...sets] : sets;
    this.title = element('h3');
    this.root = element('section', {class: 'curves heat-map', 'aria-label': 'Errors'}, this.title,
      maps.length > 1 ? choice('Error of', maps, maps[0][0], (name) => this.show(name)) : null, this.holder,
      element('p', {class: 'note'}, 'The framed pair fits best.'));
    this.show(maps[0][0]);
  }

  /** Scrolls until the framed pair is in the middle, where the table is wider than its place. */
  reveal() {
    const best = this.holder.querySelector('.best');
    if (best) this.holder.scrollLeft = best.offsetLeft - this.holder.offsetLeft - 0.5 * (this.holder.clientWidth - best.offsetWidth);
  }

  show(name) {
    const column = this.names.indexOf(name), [unit, factor] = smaller[this.unit];
    const different = (c) => [...new Set(this.rows.map((row) => row[c]))].sort((a, b) => a - b);
    const errors = this.rows.map((row) => row[column]);
    const low = Math.min(...errors), high = Math.max(...errors);
    const part = (error) => (high > low && low > 0 ? Math.log(error / low) / Math.log(high / low) : 0);
    const at = new Map(this.rows.map((row) => [`${row[0]} ${row[1]}`, row[column]]));
    const cell = (thickness, ratio) => {
      const error = at.get(`${thickness} ${ratio}`);
      if (error === undefined) return element('td');
      return element('td', {style: cellStyle(part(error)), class: error === low ? 'best' : '',
        title: `${digits(thickness)} ${this.unit} and ${digits(ratio)}: ${digits(error * factor)} ${unit}`}, digits(error * factor, 3));
    };
    const ratios = different(1);
    this.title.textContent = `Error in ${unit}: thickness of the upper layer in ${this.unit} (rows), its Young modulus over that of the lower one (columns)`;
    this.holder.replaceChildren(element('table', {class: 'heat'},
      element('thead', {}, element('tr', {}, element('th'), ratios.map((ratio) => element('th', {scope: 'col'}, digits(ratio))))),
      element('tbody', {}, different(0).map((thickness) => element('tr', {}, element('th', {scope: 'row'}, digits(thickness)), ratios.map((ratio) => cell(thickness, ratio)))))));
    this.reveal();
  }
}

export function showIdentification(data, page) {
  document.title = `Identification ${data.name} – Supple`;
  const map = new HeatMap(data), chart = new ProfileChart(data.profiles, data.unit);
  const cell = (_, text) => (text !== '' && Number.isFinite(Number(text)) ? digits(Number(text), 4) : text);
  page.replaceChildren(element('header', {}, element('h1', {}, data.name, element('span', {class: 'state'}, 'identification'))),
    ...(data.note ? [element('div', {class: 'notice bad', role: 'alert'}, data.note)] : []),
    element('ul', {class: 'study-facts'}, data.facts.map((fact) => element('li', {}, fact.replaceAll('`', '')))),
    element('section', {}, element('h2', {}, 'Pairs that fit best: thickness of the upper layer, and its Young modulus over that of the lower one'),
      element('ul', {}, data.sentences.map((text) => element('li', {}, text)))),
    element('div', {class: 'columns even'}, map.root, data.profiles.length > 0 ? chart.root : null),
    element('section', {}, element('h2', {}, `All pairs, lengths in ${data.unit}`), sortableTable(data.csv, cell)),
    element('section', {class: 'about'}, element('p', {}, `Written by Supple ${data.version}. It needs no network.`)));
  if (data.profiles.length > 0) chart.draw();
  map.reveal();
}
