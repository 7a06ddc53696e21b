// Curves of a live session, which grow.

import uPlot from 'uplot';

import {axis, lineStyle, mount, unmount} from './charts.js';
import {choice, element, styleColour} from './dom.js';
import {digits, prefixed, quantity} from './format.js';
import {Table} from './live_table.js';

const ENERGIES = ['kinetic', 'elastic', 'potential', 'contact', 'dissipated', 'rubbed', 'work', 'total'];
const WINDOWS = [['', 'whole session'], [30, 'last 30 s'], [10, 'last 10 s'], [3, 'last 3 s'], [1, 'last 1 s']];
const REDRAW = 200; // ms
const LOW = 150, HIGH = 180; // pixels: of the first charts, of the others
const value = (_, number) => (number === null || number === undefined ? '–' : digits(number, 4));

function largest(columns) {
  let size = 0;
  for (const column of columns) for (const number of column) if (Math.abs(number) > size) size = Math.abs(number);
  return size;
}

/** What all charts share: title with the unit that fits, drawn when they are seen and have something new. */
class Growing {
  constructor(title, unit, table, height = HIGH) {
    Object.assign(this, {title, unit, table, height, symbol: null, drawn: -1});
    this.heading = element('h3', {}, title);
    this.holder = element('div', {class: 'chart'});
    this.nothing = element('span', {class: 'nothing', hidden: true}, 'nothing so far');
    this.root = element('section', {class: 'curves', 'aria-label': title}, this.heading, this.nothing, this.holder);
  }

  entitle(most) {
    const [size, symbol] = prefixed(most, this.unit);
    this.size = size;
    if (symbol === this.symbol) return;
    this.symbol = symbol;
    this.heading.textContent = this.title.replace(/^[^,]*/, (name) => name + (symbol ? ` in ${symbol}` : ''));
  }

  /** Axis of the values, in the title's unit. */
  valueAxis(extra = {}) {
    const texts = (_, ticks) => ticks.map((tick) => (tick === null ? '' : digits(tick / this.size, 6)));
    return axis(null, {size: (_, ticks) => 14 + 7 * Math.max(3, ...(ticks ?? []).map((text) => String(text).length)), values: texts, ...extra});
  }

  redraw(length) {
    if (this.drawn === this.table.version && this.shownLength === length) return;
    if (this.root.clientWidth === 0) return;
    this.drawn = this.table.version;
    this.shownLength = length;
    this.draw(length);
  }

  /** Without a pointer on the chart the legend shows the last values. */
  showLast(rows) {
    const {chart} = this;
    queueMicrotask(() => {
      if (chart === this.chart && !(chart.cursor.left >= 0) && rows > 0) chart.setLegend({idx: rows - 1});
    });
  }

  /** @return whether there is anything to draw */
  showWhether(something) {
    this.nothing.hidden = something;
    this.holder.hidden = !something;
    return something;
  }

  remove() {
    if (this.chart) unmount(this.chart);
    this.root.remove();
  }
}

/** Columns against time; those in which there is nothing are not shown. */
class TimeCurves extends Growing {
  /** @param curves [[label, name of the column], ...]  @param all whether columns of zeros are shown too */
  constructor(title, unit, table, curves, {all = false, height = HIGH} = {}) {
    super(title, unit, table, height);
    this.curves = curves.filter(([, name]) => table.columns[name]);
    this.all = all;
  }

  draw(length) {
    const {columns} = this.table, time = columns.time;
    const first = length ? this.table.from('time', time.at(-1) - length) : 0;
    const curves = this.curves.map(([label, name]) => [label, columns[name].slice(first)]);
    const sizes = curves.map(([, column]) => largest([column])), most = Math.max(0, ...sizes);
    const shown = curves.filter((_, i) => this.all || sizes[i] > 1e-10 * most);
    this.entitle(most);
    if (!this.showWhether(shown.length > 0)) return;
    const labels = shown.map(([label]) => label).join();
    const data = [time.slice(first), ...shown.map(([, column]) => column)];
    if (!this.chart || labels !== this.labels) {
      this.labels = labels;
      if (this.chart) unmount(this.chart);
      this.chart = this.make(shown, data);
    } else this.chart.setData(data);
    this.showLast(data[0].length);
  }

  make(shown, data) {
    return mount({
      height: this.height,
      scales: {x: {time: false}},
      axes: [axis('time in s', {size: 34, values: (_, ticks) => ticks.map((tick) => digits(tick, 6))}), this.valueAxis()],
      series: [{label: 'time', value}, ...shown.map(([label], number) => ({label, value: (_, x) => value(_, x === null || x === undefined ? x : x / this.size), width: 1.6, points: {show: false},
        ...lineStyle(number), ...(label === 'total' ? {dash: [6, 5]} : {})}))],
      cursor: {sync: {key: 'time'}, drag: {x: false, y: false}, points: {size: 6}},
      legend: {live: true},
      padding: [8, 12, 0, 0],
    }, data, this.holder);
  }
}

/** The estimate of the error in time beside the seconds that were computed. */
class ErrorCurves extends Growing {
  constructor(table, surface) {
    super('Error in time, and seconds of computing', 'm', table);
    this.surface = surface;
    this.sentence = element('p', {class: 'note'});
    this.root.append(this.sentence);
  }

  draw() {
    const {time, error, seconds} = this.table.columns;
    this.entitle(largest([error]));
    if (!this.showWhether(time.length > 0)) return;
    if (this.chart) this.chart.setData([time, error, seconds]);
    else this.chart = this.make([time, error, seconds]);
    this.showLast(time.length);
    const last = error.at(-1), {farthest} = this.surface;
    this.sentence.textContent = time.length === 0 ? '' : `${last === null ? 'This method has no estimate of its error' : `About ${quantity(last, 'm', 2)}${farthest > 0 ? `, ${digits(100 * last / farthest, 2)} % of the largest motion` : ''}`}, for ${quantity(seconds.at(-1), 's', 2)} of computing.`;
  }

  make(data) {
    const texts = (_, ticks) => ticks.map((tick) => (tick === null ? '' : digits(tick, 4)));
    return mount({
      height: 180,
      scales: {x: {time: false}, y: {}, seconds: {}},
      axes: [axis('time in s', {size: 34, values: texts}), this.valueAxis(),
        axis('seconds', {scale: 'seconds', side: 1, size: 40, values: texts, grid: {show: false}})],
      series: [{label: 'time', value}, {label: 'error', value: (_, x) => value(_, x === null || x === undefined ? x : x / this.size), width: 1.6, points: {show: false}, ...lineStyle(0)},
        {label: 'seconds', scale: 'seconds', value, width: 1.6, points: {show: false}, ...lineStyle(1)}],
      cursor: {sync: {key: 'time'}, drag: {x: false, y: false}},
      legend: {live: true},
      padding: [8, 4, 0, 0],
    }, data, this.holder);
  }
}

/** The line through points in their order: forth and back. */
function path(chart, number) {
  const line = new Path2D();
  uPlot.orient(chart, number, (series, xs, ys, sx, sy, toX, toY, left, top, width, height) => {
    for (let i = 0; i < xs.length; ++i) line.lineTo(toX(xs[i], sx, width, left), toY(ys[i], sy, height, top));
  });
  return {stroke: line, fill: null, clip: null, band: null, gaps: null, flags: 1};
}

/** The force of a tool against its way along its axis. */
class DepthCurve extends Growing {
  /** @param way from a place to the length of the way, rising into the body  @param force from three components to what is shown */
  constructor(title, table, label, way, force) {
    super(title, 'N', table, LOW);
    Object.assign(this, {label, way, force});
  }

  draw(length) {
    const {columns} = this.table;
    const first = length ? this.table.from('time', columns.time.at(-1) - length) : 0;
    const xs = [], ys = [];
    for (let row = first; row < this.table.length; ++row) {
      xs.push(this.way(['x', 'y', 'z'].map((d) => columns[d][row])));
      ys.push(this.force(['fx', 'fy', 'fz'].map((d) => columns[d][row])));
    }
    this.entitle(largest([ys]));
    if (!this.showWhether(largest([ys]) > 0)) return;
    const [size, symbol] = prefixed(largest([xs]), 'm');
    this.wayLabel = `${this.label} in ${symbol}`;
    this.waySize = size;
    if (this.chart) this.chart.setData([null, [xs, ys]]);
    else this.chart = this.make([null, [xs, ys]]);
  }

  /** A dot where it is now. */
  markLast(chart) {
    const [xs, ys] = chart.data[1];
    if (xs.length === 0) return;
    const {ctx} = chart, x = chart.valToPos(xs.at(-1), 'x', true), y = chart.valToPos(ys.at(-1), 'y', true);
    ctx.save();
    ctx.fillStyle = styleColour('--line-2');
    ctx.beginPath();
    ctx.arc(x, y, 4 * devicePixelRatio, 0, 2 * Math.PI);
    ctx.fill();
    ctx.restore();
  }

  make(data) {
    return mount({
      mode: 2,
      height: this.height,
      hooks: {draw: [(chart) => this.markLast(chart)]},
      scales: {x: {time: false, auto: true, range: (_, low, high) => (low < high ? uPlot.rangeNum(low, high, 0.02, true) : [low - 1e-6, low + 1e-6])}, y: {auto: true}},
      axes: [axis(() => this.wayLabel, {size: 34, values: (_, ticks) => ticks.map((tick) => digits(tick / this.waySize, 6))}), this.valueAxis()],
      series: [{}, {facets: [{scale: 'x', auto: true}, {scale: 'y', auto: true}], paths: path, points: {show: false}, width: 1.6, ...lineStyle(0)}],
      cursor: {show: false},
      legend: {show: false},
      padding: [8, 12, 0, 0],
    }, data, this.holder);
  }
}

const components = (prefix) => ['x', 'y', 'z'].map((d) => [d, prefix + d]);

export class LiveCharts {
  /** @param ways of each tool: {label, way(place)} */
  constructor(data, surface, ways) {
    this.history = new Table(data.history);
    this.probes = new Table(data.probes);
    this.error = new Table(['time', 'error', 'seconds']);
    this.hands = new Table(['time', 'force']);
    this.tools = Object.fromEntries(data.tools.map(({name}) => [name, new Table(data.tool_columns)]));
    this.all = [];
    this.seen = new Set();
    this.watcher = new IntersectionObserver((entries) => entries.forEach(({target, isIntersecting}) => this.seen[isIntersecting ? 'add' : 'delete'](target)), {rootMargin: '100px'});
    this.head = element('div', {class: 'probe-head'}, element('h2', {}, 'Curves'), choice('', WINDOWS, '', (length) => { this.length = Number(length); }));
    /** Beside the body, and further below. */
    this.first = element('div', {class: 'charts'}, this.head);
    this.root = element('div', {class: 'charts'});
    const hasTools = data.tools.length > 0;
    data.tools.forEach(({name}, number) => this.addDepth(name, ways[number]));
    this.add(new TimeCurves('Force of the hand', 'N', this.hands, [['force', 'force']], {height: hasTools ? HIGH : LOW}), hasTools ? this.root : this.first);
    data.tools.forEach(({name}) => this.add(new TimeCurves(`Force of ${name}`, 'N', this.tools[name], components('f'))));
    this.addProbes(data.probes, hasTools ? this.root : this.first);
    this.add(new TimeCurves('Energies', 'J', this.history, ENERGIES.map((name) => [name, name])));
    this.add(new TimeCurves('Volume ratio of the cells', '', this.history, [['smallest', 'min_volume_ratio'], ['largest', 'max_volume_ratio']], {all: true}));
    this.add(new ErrorCurves(this.error, surface));
    this.addMore();
    setInterval(() => this.redraw(), REDRAW);
  }

  add(chart, parent = this.root) {
    this.all.push(chart);
    parent.append(chart.root);
    this.watcher.observe(chart.root);
    return chart;
  }

  drop(chart) {
    this.watcher.unobserve(chart.root);
    this.seen.delete(chart.root);
    this.all.splice(this.all.indexOf(chart), 1);
    chart.remove();
  }

  addDepth(name, {label, way, along}) {
    this.add(new DepthCurve(`Force of ${name}, against its way`, this.tools[name], label, way, along), this.first);
  }

  /** @param place of the displacement; velocity and force come below */
  addProbes(columns, place) {
    const names = [...new Set(columns.map((name) => name.match(/^(.*)\.[uvf][xyz]$/)?.[1]).filter(Boolean))];
    if (names.length === 0) return;
    const above = element('div', {class: 'probe'}), below = place === this.root ? above : element('div', {class: 'probe'});
    let shown = [];
    const show = (name) => {
      shown.forEach((chart) => this.drop(chart));
      shown = [['u', `Displacement of ${name}`, 'm', above, LOW], ['v', `Velocity of ${name}`, 'm/s', below, HIGH], ['f', `Force on ${name}, which holds or moves it`, 'N', below, HIGH]]
        .filter(([letter]) => columns.includes(`${name}.${letter}x`))
        .map(([letter, title, unit, holder, height]) => this.add(new TimeCurves(title, unit, this.probes, components(`${name}.${letter}`), {height}), holder));
    };
    show(names[0]);
    place.append(above);
    if (below !== above) this.root.append(below);
    if (names.length > 1) this.head.append(choice('Probe', names.map((name) => [name, name]), names[0], show));
  }

  addMore() {
    const more = element('details', {class: 'more'}, element('summary', {}, 'Iterations, inverted cells, momenta'));
    for (const [title, unit, curves] of [['Iterations in a step', '', ['newton_iterations', 'linear_iterations']], ['Inverted cells', '', ['inverted']],
      ['Momentum', 'kg m/s', ['px', 'py', 'pz']], ['Angular momentum', 'kg m²/s', ['lx', 'ly', 'lz']]])
      if (this.history.columns[curves[0]]) this.add(new TimeCurves(title, unit, this.history, curves.map((name) => [name.replaceAll('_', ' '), name])), more);
    this.root.append(more);
  }

  take({history = [], probes = [], tools = {}, error = [], pulls = []}) {
    this.history.add(history);
    this.probes.add(probes);
    this.error.add(error);
    for (const [name, rows] of Object.entries(tools)) this.tools[name]?.add(rows);
    const {time} = this.history.columns;
    if (history.length > 0) this.hands.add([[time.at(-1), Math.max(0, ...pulls.map(({force}) => Math.hypot(...force)))]]);
  }

  clear() {
    [this.history, this.probes, this.error, this.hands, ...Object.values(this.tools)].forEach((table) => table.clear());
  }

  /** Those on the screen. */
  redraw() {
    if (document.hidden) return;
    this.all.filter((chart) => this.seen.has(chart.root)).forEach((chart) => chart.redraw(this.length));
  }
}
