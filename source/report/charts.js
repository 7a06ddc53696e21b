// Curves over time, of studies and of identifications.

import uPlot from 'uplot';

import {element, onThemeChange, styleColour} from './dom.js';
import {digits, prefixed} from './format.js';

const PALETTE = ['--line-1', '--line-2', '--line-3', '--line-4', '--line-5', '--line-6'];
const DASHES = [[], [7, 4], [2, 3]];
const FONT = '12px system-ui, sans-serif';

/** Colour and dash of a number of lines, as many as there may be. */
export function lineStyle(number) {
  return {stroke: () => styleColour(PALETTE[number % PALETTE.length]), dash: DASHES[Math.floor(number / PALETTE.length) % DASHES.length]};
}

export function axis(label, extra = {}) {
  return {label, labelFont: FONT, font: FONT, labelSize: 18, stroke: () => styleColour('--quiet'),
    grid: {stroke: () => styleColour('--grid'), width: 1}, ticks: {stroke: () => styleColour('--grid'), width: 1, size: 5}, ...extra};
}

/** As wide as its numbers. */
const fitting = {
  size: (_, values) => 14 + 7 * Math.max(3, ...(values ?? []).map((text) => String(text).length)),
  values: (_, values) => values.map((value) => (value === null ? '' : digits(value, 6))),
};

function largest(columns) {
  let size = 0;
  for (const column of columns) for (const value of column) if (value !== null && Math.abs(value) > size) size = Math.abs(value);
  return size;
}

/** All charts of this page, to be drawn anew in other colours. */
const charts = [];
onThemeChange(() => charts.forEach((chart) => chart.redraw()));

export function mount(options, data, holder) {
  const width = () => Math.max(200, holder.clientWidth);
  const chart = new uPlot({...options, width: width() || 400}, data, holder);
  new ResizeObserver(() => {
    if (charts.includes(chart) && holder.clientWidth > 0 && Math.abs(width() - chart.width) > 1) chart.setSize({width: width(), height: options.height});
  }).observe(holder);
  charts.push(chart);
  return chart;
}

/** Takes a chart off the page. */
export function unmount(chart) {
  charts.splice(charts.indexOf(chart), 1);
  chart.destroy();
}

/** Curves of one quantity over time, or over something that rises with it, with a line at the player's. */
export class TimeChart {
  /**
   * @param title to which the unit is added, before a comma if there is one  @param curves [[name, column], ...]
   * @param x {name, label, values}; with times where the values are none  @param chosen is called with a time that is clicked on
   */
  constructor(title, unit, curves, x, chosen) {
    const [size, symbol] = prefixed(largest(curves.map(([, column]) => column)), unit);
    this.heading = element('h3', {}, title.replace(/^[^,]*/, (name) => name + (symbol ? ` in ${symbol}` : '')));
    this.holder = element('div', {class: 'chart'});
    this.root = element('section', {class: 'curves', 'aria-label': title}, this.heading, this.holder);
    this.x = x;
    this.data = [x.values, ...curves.map(([, column]) => column.map((value) => (value === null ? null : value / size)))];
    this.curves = curves;
    this.chosen = chosen;
  }

  /** To be called when the page has room for it. */
  draw() {
    const value = (_, number) => (number === null || number === undefined ? '–' : digits(number, 4));
    this.chart = mount({
      height: 190,
      scales: {x: {time: false}},
      axes: [axis(this.x.label, {size: 34, values: fitting.values}), axis(null, fitting)],
      series: [{label: this.x.name, value}, ...this.curves.map(([label], number) => ({label, value, width: 1.6, points: {show: this.x.values.length < 25, size: 5},
        ...lineStyle(number), ...(label === 'total' ? {dash: [6, 5]} : {})}))],
      cursor: {...(this.x.times ? {} : {sync: {key: 'time'}}), drag: {x: true, y: false}, points: {size: 6}},
      legend: {live: true},
      hooks: {ready: [() => queueMicrotask(() => this.set(this.time))], setSize: [() => this.set(this.time)]},
      padding: [8, 12, 0, 0],
    }, this.data, this.holder);
    this.line = element('div', {class: 'player-line'});
    this.chart.over.append(this.line);
    this.chart.over.addEventListener('click', (event) => {
      if (this.chart.select.width >= 2) return;
      this.chosen(this.x.times ? this.x.times[this.chart.posToIdx(event.offsetX)] : this.chart.posToVal(event.offsetX, 'x'));
    });
  }

  set(time) {
    this.time = time;
    if (!this.line || time === undefined) return;
    const idx = Math.max(0, (this.x.times ?? this.x.values).findLastIndex((t) => t <= time * (1 + 1e-9)));
    const place = this.chart.valToPos(this.x.times ? this.x.values[idx] : time, 'x');
    this.line.hidden = !(place >= 0 && place <= this.chart.over.clientWidth);
    this.line.style.transform = `translateX(${place}px)`;
    if (this.chart.cursor.left >= 0) return; // the pointer shows another instant
    this.chart.setLegend({idx});
  }
}

/** Error of many runs against what they cost, both logarithmic; a curve for each series. */
export class ErrorChart {
  constructor(title, xLabel, rows, abscissa) {
    this.holder = element('div', {class: 'chart tall'});
    this.pointed = element('p', {class: 'note'}, 'Point at the curves to see which run it is.');
    this.root = element('section', {class: 'curves', 'aria-label': title}, element('h3', {}, title), this.holder, this.pointed);
    this.xLabel = xLabel;
    this.abscissa = abscissa;
    this.rows = rows.filter((row) => row.done && row.error > 0 && row[abscissa] > 0);
  }

  draw() {
    const names = [...new Set(this.rows.map((row) => row.curve))];
    const curves = names.map((name) => this.rows.filter((row) => row.curve === name).sort((a, b) => a[this.abscissa] - b[this.abscissa]));
    const front = this.rows.filter((row) => row.front).sort((a, b) => a[this.abscissa] - b[this.abscissa]);
    const columns = (list) => [list.map((row) => row[this.abscissa]), list.map((row) => 100 * row.error)];
    const logarithmic = {size: (_, values) => 14 + 7 * Math.max(3, ...(values ?? []).map((text) => String(text ?? '').length)),
      values: (_, values) => values.map((value) => (value === null ? '' : digits(value, 3)))};
    const withFront = this.abscissa === 'seconds' && front.length > 1;
    const lists = withFront ? [...curves, front] : curves;
    const value = (_, number) => (number === null || number === undefined ? '–' : `${digits(number, 3)} %`);
    this.chart = mount({
      height: 360,
      scales: {x: {time: false, distr: 3}, y: {distr: 3}},
      axes: [axis(this.xLabel, {...logarithmic, size: 34}), axis('error in %', logarithmic)],
      series: [{label: this.xLabel, value: (_, x) => digits(x, 3)}, ...names.map((label, number) => ({label, value, width: 1.4, spanGaps: true, points: {show: true, size: 6}, ...lineStyle(number)})),
        ...(withFront ? [{label: 'no other is better and quicker', value, width: 5, spanGaps: true, stroke: () => styleColour('--front'), points: {show: false}}] : [])],
      cursor: {drag: {x: true, y: true}},
      hooks: {setCursor: [(chart) => this.point(chart)]},
      padding: [8, 12, 0, 0],
    }, uPlot.join(lists.map(columns)), this.holder);
  }

  /** Names the run next to the pointer. */
  point(chart) {
    const {left, top} = chart.cursor;
    if (!(left >= 0)) return;
    let nearest = null, least = 30 ** 2;
    for (const row of this.rows) {
      const square = (chart.valToPos(row[this.abscissa], 'x') - left) ** 2 + (chart.valToPos(100 * row.error, 'y') - top) ** 2;
      if (square < least) [nearest, least] = [row, square];
    }
    if (nearest) this.pointed.textContent = `${nearest.label}: ${digits(100 * nearest.error, 3)} % in ${digits(nearest.seconds, 3)} s`;
  }
}

/** Measured and computed surfaces, downwards: points and lines of one colour for each set. */
export class ProfileChart {
  /** @param profiles [{set, pair, distances, measured, computed: {side: depths}}, ...] */
  constructor(profiles, unit) {
    this.holder = element('div', {class: 'chart tall'});
    this.root = element('section', {class: 'curves', 'aria-label': 'Profiles'}, element('h3', {}, `Depth of the surface in ${unit}: measured (points), and by the best pair of each set (lines)`), this.holder);
    this.profiles = profiles;
    this.unit = unit;
  }

  draw() {
    const value = (_, number) => (number === null || number === undefined ? '–' : digits(number, 4));
    const tables = [], series = [];
    this.profiles.forEach(({set, pair, distances, measured, computed}, number) => {
      const sides = Object.entries(computed), {stroke} = lineStyle(number);
      const order = distances.map((_, i) => i).sort((i, j) => distances[i] - distances[j]);
      const sorted = (column) => order.map((i) => column[i]);
      tables.push([distances, measured, ...sides.map(([, depths]) => depths)].map(sorted));
      series.push({label: `set ${set}, measured`, value, stroke, paths: () => null, points: {show: true, size: 7, fill: stroke}});
      sides.forEach(([side, ], n) => series.push({label: `set ${set}, ${pair}${sides.length > 1 ? `, ${side}` : ''}`, value, stroke, width: 2, dash: DASHES[n], spanGaps: true, points: {show: false}}));
    });
    this.chart = mount({
      height: 360,
      scales: {x: {time: false}, y: {dir: -1}},
      axes: [axis(`distance from the needle in ${this.unit}`, {size: 34, values: fitting.values}), axis(null, fitting)],
      series: [{label: 'distance', value}, ...series],
      cursor: {drag: {x: true, y: true}},
      padding: [8, 12, 0, 0],
    }, uPlot.join(tables), this.holder);
  }
}
