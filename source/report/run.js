// The page of a run.

import {TimeChart} from './charts.js';
import {choice, element} from './dom.js';
import {count, digits, prefixed, quantity} from './format.js';
import {Player} from './player.js';
import {parameterList, summaryList} from './lists.js';
import {Stage} from './stage.js';
import {Surface} from './surface.js';

const ENERGIES = ['kinetic', 'elastic', 'potential', 'contact', 'dissipated', 'rubbed', 'work', 'total'];

/** What went wrong and what to know, before all else. */
function notices({status, warnings: told, extremes}) {
  const list = [], inverted = extremes?.most_inverted ?? 0;
  const warnings = inverted > 0 && !told.some((text) => /inside out|inverted/.test(text)) ? [...told, `Up to ${count(inverted, 'cell')} at once ${inverted === 1 ? 'was' : 'were'} inside out (volume ratio ${digits(extremes.min_volume_ratio, 3)}): do not trust the motion there.`] : told;
  if (status !== 'done') {
    const failed = status.startsWith('failed');
    const text = failed ? status.replace(/^failed: /, '') : 'The run was interrupted. What is shown ends there.';
    list.push(element('div', {class: `notice ${failed ? 'bad' : 'warn'}`, role: 'alert'}, element('strong', {}, failed ? 'The computation failed. ' : 'Interrupted. '), text));
  }
  if (warnings.length > 0)
    list.push(element('div', {class: 'notice warn'}, element('strong', {}, warnings.length === 1 ? 'Warning' : 'Warnings'),
      element('ul', {}, warnings.map((text) => element('li', {}, text)))));
  return list;
}

function header(data, surface) {
  const {summary} = data;
  const [state] = summary.status.split(':');
  const [size, metres] = prefixed(surface ? Math.max(...surface.extent) : 1, 'm');
  const extent = surface ? `${surface.extent.filter((_, d) => d < 2 || !surface.flat).map((length) => digits(length / size, 3)).join('\u00a0× ')}\u00a0${metres}` : null;
  const facts = [
    `${digits(summary.cells)} cells, ${digits(summary.vertices)} vertices${extent ? ` in ${extent}` : ''}`,
    summary.method,
    `${count(summary.steps, data.static ? 'load step' : 'step')} in ${quantity(summary.seconds.run, 's', 3)}`,
    summary.ranks > 1 ? `${summary.ranks} processes` : null,
  ];
  return element('header', {}, element('h1', {}, data.name, element('span', {class: `state ${state}`}, state)),
    element('p', {class: 'facts'}, facts.filter(Boolean).map((fact) => element('span', {}, fact))));
}

/** Whether there is anything to see in a column. */
const size = (column) => column.reduce((most, value) => Math.max(most, Math.abs(value ?? 0)), 0);
const tells = (column) => column && size(column) > 0;

/** The components x, y, z of a quantity that are more than round-off. */
function components(columns, name) {
  const all = ['x', 'y', 'z'].map((d) => [d, columns[name + d]]).filter(([, column]) => tells(column));
  const most = Math.max(...all.map(([, column]) => size(column)));
  return all.filter(([, column]) => size(column) > 1e-10 * most);
}

const varies = (column) => column && column.some((value) => value !== null && Math.abs(value - column.at(-1)) > 1e-6 * Math.abs(value));

class Charts {
  constructor(data, chosen) {
    this.data = data;
    this.chosen = chosen;
    this.all = [];
    this.root = element('div', {class: 'charts'});
    this.addHistory();
    this.addTools();
    this.addProbes();
    this.addProfiles();
    this.addError();
  }

  x(table) {
    return {name: this.data.static ? 'load' : 'time', label: this.data.static ? 'load factor' : 'time in s', values: table.columns.time};
  }

  add(title, unit, curves, table, parent = this.root, x = this.x(table)) {
    if (curves.length === 0 || table.columns.time.length < 2) return null;
    const chart = new TimeChart(title, unit, curves, x, this.chosen);
    this.all.push(chart);
    parent.append(chart.root);
    return chart;
  }

  addHistory() {
    const table = this.data.tables.history;
    if (!table) return;
    const {columns} = table;
    const some = (names) => names.filter((name) => tells(columns[name])).map((name) => [name.replaceAll('_', ' '), columns[name]]);
    this.add('Energies', 'J', some(ENERGIES), table);
    this.add('Volume ratio of the cells', '', [['smallest', columns.min_volume_ratio], ['largest', columns.max_volume_ratio]], table);
    const dt = columns.dt.map((value, row) => (row === 0 && value === 0 ? columns.dt[1] ?? null : value));
    if (varies(dt)) this.add(this.data.static ? 'Load step' : 'Step size', this.data.static ? '' : 's', [['step', dt]], table);
    else if (dt.length > 1) this.root.append(element('p', {class: 'note'}, `Every ${this.data.static ? 'load step' : 'step'} is ${this.data.static ? digits(dt[1]) : quantity(dt[1], 's')}.`));
    if (columns.space_error) this.add('Error in space, of the elastic energy', '', some(['space_error']), table);
    this.addMore(table, some);
  }

  addMore(table, some) {
    this.more = element('details', {class: 'more'}, element('summary', {}, 'Iterations, inverted cells, momenta'));
    this.add('Iterations in a step', '', some(['newton_iterations', 'linear_iterations']), table, this.more);
    this.add('Inverted cells', '', some(['inverted']), table, this.more);
    this.add('Momentum', 'kg m/s', some(['px', 'py', 'pz']), table, this.more);
    this.add('Angular momentum', 'kg m²/s', some(['lx', 'ly', 'lz']), table, this.more);
    this.more.addEventListener('toggle', () => this.draw());
    if (this.more.children.length > 1) this.tail = this.more;
  }

  /** The force of each tool on the body, and how deep that is within it. */
  addTools() {
    for (const [name, table] of Object.entries(this.data.tables)) {
      if (!name.startsWith('tool_')) continue;
      const tool = name.slice(5);
      this.add(`Force of ${tool}`, 'N', components(table.columns, 'f'), table);
      this.add(`Depth of the body in ${tool}`, 'm', tells(table.columns.depth) ? [['depth', table.columns.depth]] : [], table);
    }
  }

  addProbes() {
    const table = this.data.tables.probes;
    const names = table ? [...new Set(Object.keys(table.columns).map((name) => name.match(/^(.*)\.[uvf][xyz]$/)?.[1]).filter(Boolean))] : [];
    if (names.length === 0) return;
    const holder = element('div', {class: 'probe'});
    const show = (name) => {
      this.all = this.all.filter((chart) => chart.parent !== holder);
      holder.replaceChildren();
      for (const [letter, title, unit] of [['u', 'Displacement', 'm'], ['v', 'Velocity', 'm/s'], ['f', 'Force, which holds or moves it', 'N']]) {
        const chart = this.add(title, unit, components(table.columns, `${name}.${letter}`), table, holder);
        if (chart) chart.parent = holder;
      }
      this.addForceAgainstWay(name, table, holder);
      if (holder.children.length === 0) holder.append(element('p', {class: 'note'}, 'It does not move, and no force holds it.'));
      this.draw();
    };
    const moving = names.find((name) => ['x', 'y', 'z'].some((d) => tells(table.columns[`${name}.u${d}`]))) ?? names[0];
    this.root.append(element('div', {class: 'probe-head'}, element('h2', {}, 'Probe'), names.length > 1 ? choice('', names.map((name) => [name, name]), moving, show) : element('span', {}, names[0])), holder);
    this.showProbe = () => show(moving);
  }

  /** Of a static run, where a vertex or region is pushed: over the component of its displacement that is largest. */
  addForceAgainstWay(name, {columns}, holder) {
    const forces = components(columns, `${name}.f`);
    const way = ['x', 'y', 'z'].map((d) => columns[`${name}.u${d}`]).reduce((a, b) => (size(b) > size(a) ? b : a)).map(Math.abs);
    if (!this.data.static || forces.length === 0 || way.some((u, row) => row > 0 && !(u > way[row - 1]))) return;
    const [unit, symbol] = prefixed(way.at(-1), 'm');
    const x = {name: 'displacement', label: `displacement in ${symbol}`, values: way.map((u) => u / unit), times: columns.time};
    const chart = this.add('Force, against displacement', 'N', forces, {columns}, holder, x);
    if (chart) chart.parent = holder;
  }

  /** The depth of a profile's vertex farthest down tells most over time. */
  addProfiles() {
    for (const [name, table] of Object.entries(this.data.tables)) {
      if (!name.startsWith('profile_')) continue;
      const deepest = new Map();
      table.columns.time.forEach((time, row) => deepest.set(time, Math.max(deepest.get(time) ?? -Infinity, table.columns.depth[row])));
      this.add(`Depth of ${name.slice(8)}`, 'm', [['deepest', [...deepest.values()]]], {columns: {time: [...deepest.keys()]}});
    }
  }

  addError() {
    const table = this.data.tables.error;
    if (table) this.add('Error, by the second run', 'm', [['error', table.columns.error]], table);
  }

  /** Those that have room now and had none before. */
  draw() {
    for (const chart of this.all)
      if (!chart.chart && chart.holder.clientWidth > 0) chart.draw();
    this.set(this.time);
  }

  set(time) {
    this.time = time;
    if (time !== undefined) this.all.forEach((chart) => chart.set(time));
  }

  facts() {
    return Object.entries(this.data.tables).filter(([, table]) => table.shown < table.rows)
      .map(([name, table]) => `${digits(table.shown)} of the ${digits(table.rows)} rows of ${name}.csv are in this page${name.startsWith('profile_') ? '' : ', those with extremes among them'}.`);
  }
}

async function readSurface(data, text) {
  if (!data.surface?.times.length) return [null, null];
  try {
    return [await Surface.read({...data.surface, tools: data.tools ?? []}, text), null];
  } catch (error) {
    return [null, element('p', {class: 'notice warn'}, `This browser can't unpack the motion of the body (${error.message}). The curves are whole.`)];
  }
}

function makeStage(surface, up) {
  try {
    return new Stage(surface, up);
  } catch (error) {
    document.querySelector('body > .body-view')?.remove();
    return element('p', {class: 'notice warn'}, `This browser can't draw the body (${error.message}). The curves need no WebGL.`);
  }
}

/** What the player runs over: the frames, or the rows of the history if there are none. */
function instants(data, surface) {
  return surface?.times ?? data.tables.history?.columns.time ?? [0];
}

export async function showRun(data, surfaceText, page) {
  document.title = `${data.name} – Supple`;
  const [surface, problem] = await readSurface(data, surfaceText);
  const stage = surface ? makeStage(surface, data.up) : problem;
  const charts = new Charts(data, (time) => player.jump(time));
  const player = new Player(instants(data, surface), data.static, (time) => {
    if (stage instanceof Stage) stage.set({time});
    charts.set(time);
  });
  const beginning = surface && surface.times[0] > (data.tables.history?.columns.time[0] ?? 0)
    ? [`The body is shown from ${data.static ? 'load factor' : 'time'} ${digits(surface.times[0])} on, where the run was gone on with; the curves show all of it.`] : [];
  const about = [...(stage instanceof Stage ? stage.facts() : []), ...beginning, ...charts.facts(),
    'Drag to turn, wheel or two fingers to zoom, right button to move. Keys: space plays, ← → go from frame to frame, Home and End; w mesh, g undeformed; in the view arrows turn, + − zoom, 0 resets. A click on a curve goes to that instant, dragging zooms in, a double click shows all.'];
  page.replaceChildren(header(data, surface), ...notices(data.summary),
    element('div', {class: surface ? 'columns' : 'columns alone'},
      element('div', {class: 'left'}, stage instanceof Stage ? stage.root : stage, player.root, stage instanceof Stage ? stage.controls : null), element('div', {class: 'right'}, charts.root, charts.tail)),
    summaryList(data.summary, data.static), parameterList(data.parameters),
    element('section', {class: 'about'}, element('h2', {}, 'About this page'), about.map((text) => element('p', {}, text)),
      element('p', {}, `Written by Supple ${data.summary.versions.supple}. It needs no network.`)));
  charts.draw();
  charts.showProbe?.();
  const failed = data.summary.status.startsWith('failed'); // what is looked for then is how it ended
  player.set(surface && !failed ? surface.times[surface.farthestFrame] : player.last);
  document.addEventListener('keydown', (event) => {
    if (!(stage instanceof Stage) || event.target.closest('input, select') || event.ctrlKey || event.metaKey) return;
    if (event.key === 'w') stage.wireButton.click();
    if (event.key === 'g') stage.ghostButton.click();
  });
}
