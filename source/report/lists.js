// The summary and the parameters, as lists.

import {element} from './dom.js';
import {digits, quantity} from './format.js';

function entries(title, pairs) {
  const shown = pairs.filter(([, value]) => value !== null && value !== undefined);
  if (shown.length === 0) return null;
  return element('div', {class: 'group'}, element('h3', {}, title),
    element('dl', {}, shown.flatMap(([name, value]) => [element('dt', {}, name), element('dd', {}, value)])));
}

const words = (name) => name.replaceAll('_', ' ');
const percent = (part) => `${digits(100 * part, 3)} %`;

function spaceEntries(space) {
  if (!space) return [];
  const {unknown, more_than: least, energy, work, frequency} = space;
  const probes = Object.entries(space.probes ?? {}).map(([name, error]) => [`in space, of ${name}`, error === null ? 'more than 50 %' : percent(Math.abs(error))]);
  return [...probes, ['in space, of the energy', unknown ? `unknown, for ${unknown}` : least ? `more than ${percent(least)}` : `${percent(work)} (${percent(energy)} in the energy norm)`],
    ['in space, of a swing', frequency === undefined ? null : `too quick by ${percent(frequency)}`],
    ['jumps over recovery', space.lock_ratio === undefined ? null : digits(space.lock_ratio, 3)]];
}

function timeEntries(error) {
  if (error.largest_motion === undefined) return [];
  const second = error.step_doubling;
  return [['largest motion', quantity(error.largest_motion, 'm')],
    ['sum of local errors', error.sum_of_local_errors === null ? 'unknown for this method' : `${quantity(error.sum_of_local_errors, 'm', 3)} (${percent(error.relative)} of the motion)`],
    ['by a second run', !second ? null : second.failed ? `unknown: ${second.failed}` : `${second.at_least ? 'more than ' : ''}${quantity(second.largest, 'm', 3)} (${percent(second.relative)}${second.order === undefined ? '' : `, order ${digits(second.order, 2)}`})`]];
}

function secondMeshEntries(second) {
  if (!second) return [];
  const order = second.order !== undefined ? `, order ${digits(second.order, 2)}` : second.order_assumed !== undefined ? `, order ${digits(second.order_assumed, 2)} assumed` : '';
  const probes = Object.entries(second.probes ?? {}).map(([name, error]) => [`by a second mesh, of ${name}`, percent(error.relative)]);
  return [['in space, by a second mesh', second.failed ? `unknown: ${second.failed}` :
    `${second.at_least ? 'more than ' : ''}${quantity(second.largest, 'm', 3)} (${percent(second.relative)} of the motion; ${second.mesh}${order})`], ...probes];
}

function errorEntries(error) {
  return error ? [...timeEntries(error), ...spaceEntries(error.space), ...secondMeshEntries(error.second_mesh)] : [];
}

/** Where the time went. */
function phases(seconds) {
  const parts = Object.entries(seconds).filter(([name, value]) => name !== 'run' && value > 0).sort(([, a], [, b]) => b - a);
  const longest = Math.max(...parts.map(([, value]) => value));
  return element('div', {class: 'group'}, element('h3', {}, 'Seconds'),
    element('table', {class: 'phases'}, parts.map(([name, value]) => element('tr', {}, element('th', {scope: 'row'}, words(name)), element('td', {}, quantity(value, 's', 3)),
      element('td', {class: 'share'}, element('span', {style: `width: ${100 * value / longest}%`}))))));
}

export function summaryList(summary, stationary) {
  const {solver, last, extremes} = summary;
  const built = Object.entries(summary.built).map(([name, value]) => [words(name), typeof value === 'boolean' ? (value ? 'yes' : 'no') : digits(value)]);
  return element('section', {class: 'summary'}, element('h2', {}, 'Summary'), element('div', {class: 'groups'},
    entries('Body', [['cells', digits(summary.cells)], ['vertices', digits(summary.vertices)], ['unknowns', `${digits(summary.dofs)}, of which ${digits(summary.held)} are held`],
      ['volume', `${digits(summary.volume)} m³`], ['farthest from rest', quantity(summary.distance_from_rest, 'm')], ['processes', digits(summary.ranks)]]),
    entries('Method', [['time', summary.method], ['stable step', summary.stable_step ? quantity(summary.stable_step.step, 's', 3) : null], ['solver', `${solver.name}: ${solver.reason}`],
      ['worst residual', `${digits(solver.max_relative_residual, 3)} (tolerance ${digits(solver.tolerance)})`],
      ['solves', digits(solver.solves)], ['iterations', `${digits(solver.iterations)} linear, ${digits(solver.newton_iterations)} Newton`],
      [stationary ? 'load steps' : 'steps', `${digits(summary.steps)}, ${digits(summary.rejected_steps)} rejected, ${digits(summary.failed_steps)} failed`],
      ['per second', `${digits(summary.steps_per_second, 3)} steps`]]),
    entries('Accuracy', errorEntries(summary.error_estimate)),
    last ? entries('At the end', ['kinetic', 'elastic', 'potential', 'dissipated', 'total', 'work'].map((name) => [name, quantity(last[name], 'J')])) : null,
    extremes ? entries('Worst of the run', [['volume ratio', `${digits(extremes.min_volume_ratio)} to ${digits(extremes.max_volume_ratio)}`],
      ['inverted cells', digits(extremes.most_inverted)], ['rises of energy', digits(extremes.energy_rises)]]) : null,
    phases(summary.seconds), entries('What was built', built), entries('Versions', Object.entries(summary.versions))));
}

/** parameters.prm, with a field that looks for words in it. */
export function parameterList(text) {
  const sections = [];
  for (const line of text.split('\n')) {
    const section = line.match(/^subsection (.*)$/), entry = line.match(/^\s*set (.*?)\s*=\s?(.*)$/);
    if (section) sections.push({name: section[1], entries: []});
    else if (entry) sections.at(-1)?.entries.push([entry[1], entry[2].replace(/\s+#.*$/, '')]);
  }
  const groups = sections.filter((section) => section.entries.length > 0).map(({name, entries: list}) => {
    const rows = list.map(([key, value]) => ({text: `${name} ${key} ${value}`.toLowerCase(), nodes: [element('dt', {}, key), element('dd', {}, value || '–')]}));
    return {rows, root: element('div', {class: 'group'}, element('h3', {}, name), element('dl', {}, rows.flatMap((row) => row.nodes)))};
  });
  const search = element('input', {type: 'search', placeholder: 'Find a parameter', 'aria-label': 'Find a parameter'});
  search.addEventListener('input', () => {
    for (const {rows, root} of groups) {
      for (const row of rows) row.nodes.forEach((node) => { node.hidden = !row.text.includes(search.value.toLowerCase()); });
      root.hidden = rows.every((row) => row.nodes[0].hidden);
    }
  });
  return element('details', {class: 'parameters'}, element('summary', {}, element('h2', {}, 'Parameters')), search,
    element('div', {class: 'groups'}, groups.map((group) => group.root)));
}
