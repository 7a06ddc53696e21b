// The page of a live session: what the program computes is seen as it is computed, and moved by hand.

import {Vector3} from 'three';

import {element} from './dom.js';
import {digits, quantity} from './format.js';
import {Again} from './live_again.js';
import {LiveCharts} from './live_charts.js';
import {Clock} from './live_clock.js';
import {Entries} from './live_entries.js';
import {HandControls} from './live_hand_controls.js';
import {Hand} from './live_hand.js';
import {Connection} from './live_socket.js';
import {LiveStage} from './live_stage.js';
import {LiveSurface} from './live_surface.js';
import {Timing} from './live_timing.js';
import {Tools} from './live_tools.js';

const STATES = {
  lost: ['connection lost', 'failed', 'The connection to the program is lost. The page tries again each second.'],
  taken: ['taken', 'interrupted', 'Another page has this session. This one takes over when that one is closed.'],
  foreign: ['over', 'failed', 'This session is over. The address of another one is where Supple was started.'],
  ended: ['ended', 'interrupted', 'The session has ended.'],
};

/** Takes the token out of the address, where others might see it. */
function takeToken() {
  const token = new URLSearchParams(location.search).get('token') ?? '';
  history.replaceState(null, '', location.pathname);
  return token;
}

class Session {
  constructor(data, surface, connection) {
    Object.assign(this, {data, surface, connection});
    this.say = (command, refused = (message) => this.tell(message.message)) => connection.say(command, refused);
    this.state = {running: data.running, speed: data.speed, entries: {}, warnings: []};
    this.stage = new LiveStage(surface, data.up, connection, (frame) => this.drawn(frame));
    this.tools = new Tools(data.tools, data.up, surface, connection);
    this.hand = new Hand(this.stage, connection, this.tools, (text) => this.tell(text));
    this.stage.hand = this.hand;
    this.hands = new HandControls(this.hand, data.tools.length > 0, (text) => { this.stage.hint.textContent = text; });
    this.clock = new Clock(this.say, data.speed);
    this.entries = new Entries(data.entries, connection);
    this.again = new Again(this.say);
    this.timing = new Timing(connection);
    this.charts = new LiveCharts(data, surface, data.tools.map((_, number) => this.tools.describe(number)));
    this.badge = element('span', {class: 'state'}, 'connecting');
    this.notices = element('div', {});
    /** Below the body, and a word of them on top: the body must not move under a hand. */
    this.warnings = element('div', {id: 'warnings'});
    this.warned = element('a', {class: 'state interrupted', href: '#warnings', hidden: true});
    this.facts = element('p', {class: 'facts'});
    this.toast = element('div', {class: 'toast', role: 'status', hidden: true});
    this.stage.frame.append(this.toast);
    document.addEventListener('keydown', (event) => this.key(event));
  }

  root() {
    const {data} = this;
    const keys = 'Keys: space runs and pauses, s makes a single step, Shift+R starts again, Esc releases all, 1 to 5 choose what the hand does, Alt and dragging turns the view on the body too; w mesh, g undeformed; in the view arrows turn, + − zoom, 0 resets.';
    const end = element('button', {type: 'button', onclick: () => this.say('quit')}, 'End the session');
    this.showFacts();
    return [element('header', {}, element('h1', {}, data.name, this.badge, this.warned), this.facts), this.notices,
      element('div', {class: 'columns live'},
        element('div', {class: 'left'}, this.stage.root, this.clock.root, this.hands.root, this.stage.controls, this.warnings),
        element('div', {class: 'right'}, element('div', {class: 'beside'}, this.tools.root, this.charts.first), element('div', {class: 'settings'}, this.entries.root, this.again.root), this.charts.root)),
      element('section', {class: 'about'}, element('h2', {}, 'About this page'), element('p', {}, keys),
        element('p', {}, 'All that is done here is written down; the scene and the motion file in the output folder repeat it. Drawn are the states that were computed, not all of them where they come faster than the screen; displacements have 16 bits here. The files have all digits.'),
        element('p', {}, end), element('p', {}, `Supple ${data.version}. This page speaks with the program on this computer alone.`))];
  }

  showFacts() {
    const {cells, dofs, vertices, processes, threads} = this.data, {method = this.data.method, step_size: step = this.data.step} = this.state;
    const facts = [`${digits(cells)} cells, ${digits(dofs)} unknowns, ${digits(vertices)} vertices on the surface`, method, step ? `steps of ${quantity(step, 's')}` : 'variable steps',
      processes > 1 ? `${processes} processes` : null, threads > 1 ? `${threads} threads` : null];
    this.facts.replaceChildren(...facts.filter(Boolean).map((fact) => element('span', {}, fact)));
  }

  showBadge() {
    const [text, kind] = STATES[this.status] ?? (this.failure ? ['step failed', 'failed'] : this.state.running ? ['running', 'running'] : ['paused', 'paused']);
    this.badge.textContent = text;
    this.badge.className = `state ${kind}`;
    this.stage.showCover(STATES[this.status]?.[2]);
    for (const root of [this.clock.root, this.hands.root, this.tools.root, this.again.root]) if (root) root.inert = this.status !== 'open';
    if (this.entries.root) this.entries.root.inert = this.status === 'ended' || this.status === 'foreign';
    document.title = `${this.data.name}, ${text} – Supple`;
  }

  showNotices() {
    const notice = (kind, title, text) => element('div', {class: `notice ${kind}`, role: 'alert'}, element('strong', {}, `${title} `), text);
    const {warnings = []} = this.state, list = [];
    if (this.ending) list.push(notice('warn', 'Ended.', this.ending));
    if (this.complaint) list.push(notice('bad', 'The program closed the connection.', this.complaint));
    if (this.failure) list.push(notice('bad', 'A step failed.', `${this.failure} The session is paused in the state before it.`));
    const text = list.map((node) => node.textContent).join('\n');
    if (text !== this.noticed) this.notices.replaceChildren(...list);
    this.noticed = text;
    this.showWarnings(warnings);
  }

  showWarnings(list) {
    const text = list.join('\n');
    if (text === this.warnedOf) return;
    this.warnedOf = text;
    this.warned.hidden = list.length === 0;
    this.warned.textContent = list.length === 1 ? '1 warning' : `${list.length} warnings`;
    this.warnings.replaceChildren(...list.map((warning) => element('div', {class: 'notice warn', role: 'status'}, warning)));
  }

  /** A word over the body, which goes away. */
  tell(text) {
    this.toast.textContent = text;
    this.toast.hidden = false;
    clearTimeout(this.toasting);
    this.toasting = setTimeout(() => { this.toast.hidden = true; }, 5000);
  }

  /** What the connection tells. */
  changed(status, reason) {
    this.status = status;
    if (status !== 'open') this.hand.forgetAll();
    else this.settled = false;
    this.complaint = status === 'lost' && reason ? `${reason}.` : status === 'open' ? null : this.complaint;
    this.showBadge();
    this.showNotices();
  }

  frame() {
    this.timing.arrived(this.connection.frame);
    this.stage.view.invalidate();
  }

  drawn(frame) {
    this.connection.drawn();
    this.timing.drawn(frame.command);
    this.newest = frame;
    this.clock.show(frame);
    if (!this.settled || !this.tools.touched) this.tools.settle(frame.poses);
    if (frame.command !== this.command) this.entries.take(this.state.entries, frame.command);
    this.command = frame.command;
    this.settled = true;
    if (frame.session !== this.session) this.begin(frame.session);
  }

  /** Another session: the first one, or one after a reset. */
  begin(session) {
    if (this.session !== undefined && session !== this.session) {
      this.charts.clear();
      this.hand.forgetAll();
      this.surface.farthest = this.surface.farthestNow;
      this.tools.touched = false;
      this.tools.take(this.charts.tools);
      this.settled = false;
    }
    this.session = session;
  }

  onState(message) {
    this.state = message;
    if (message.session !== undefined) this.begin(message.session);
    if (message.running) this.failure = null;
    this.clock.showRunning(message.running);
    this.clock.showSpeed(message.speed);
    this.entries.take(message.entries ?? {}, this.command);
    this.showFacts();
    this.showBadge();
    this.showNotices();
  }

  onRows(message) {
    this.charts.take(message);
    this.tools.take(this.charts.tools);
    if (message.pulls) this.hand.hear(message.pulls);
  }

  onFailed({message}) {
    this.failure = message;
    this.state.running = false;
    this.clock.showRunning(false);
    this.showBadge();
    this.showNotices();
  }

  onEnded({message}) {
    this.status = 'ended';
    this.ending = message;
    this.hand.forgetAll();
    this.showBadge();
    this.showNotices();
  }

  key(event) {
    if (event.ctrlKey || event.metaKey || event.altKey) return;
    if (event.target.closest('input[type=text], select, textarea')) return;
    const onButton = event.target.closest('button, summary, a, input');
    if (event.key === ' ' && !onButton) this.clock.toggle();
    else if (event.key === 's') this.say('step');
    else if (event.key === 'R' && event.shiftKey && !event.repeat) this.say('reset');
    else if (event.key === 'Escape') this.hand.releaseAll();
    else if (event.key === 'w') this.stage.wireButton.click();
    else if (event.key === 'g') this.stage.ghostButton.click();
    else if (/^[1-5]$/.test(event.key)) this.hands.key(Number(event.key));
    else return;
    event.preventDefault();
  }
}

/** For who drives the page from outside: places are in metres, points in pixels of the window. */
function makeHooks(session) {
  const {stage: {view}, surface, hand} = session;
  const onScreen = (place) => {
    const point = view.project(place), box = view.canvas.getBoundingClientRect();
    return point && {x: box.left + point.x, y: box.top + point.y};
  };
  return {
    state: () => ({...session.state, status: session.status, failure: session.failure ?? null, session: session.session}),
    step: () => session.newest?.step ?? 0,
    time: () => session.newest?.time ?? 0,
    /** Where a vertex, by its number in the mesh, is drawn. */
    screenOf: (number) => onScreen(view.placeOf(surface.placeOfNumber.get(number))),
    /** Where a place would be drawn. */
    project: (place) => onScreen(new Vector3(...place)),
    /** The number of the vertex of the surface that is nearest to a place at rest. */
    nearest: (place) => {
      const distance = (v) => Math.hypot(...[0, 1, 2].map((d) => surface.rest[3 * v + d] - place[d]));
      return surface.numbers[[...surface.numbers.keys()].reduce((best, v) => (distance(v) < distance(best) ? v : best), 0)];
    },
    /** Where a vertex is at rest. */
    restOf: (number) => [...surface.rest.subarray(3 * surface.placeOfNumber.get(number), 3 * surface.placeOfNumber.get(number) + 3)],
    /** {vertex, step, force, mean, size} of the hand that was heard of last, or null. */
    lastForce: () => hand.last ?? null,
    /** The newest row of probes.csv, by its columns. */
    probes: () => session.charts.probes.last(),
    /** The newest row of a tool's table, by its columns. */
    tool: (name) => session.charts.tools[name].last(),
    /** Where a tool is wanted. */
    wanted: (name) => session.tools.wanted[session.data.tools.findIndex((tool) => tool.name === name)],
    /** Numbers of the vertices in hands. */
    grabbed: () => [...hand.pulls.keys()],
    /** Says a command: milliseconds until a frame that knows of it has arrived, and until it was drawn. */
    timed: (command) => session.timing.say(command),
    /** How many frames were drawn. */
    frames: () => session.timing.frames,
  };
}

async function readSurface(data, address) {
  const answer = await fetch(address);
  if (!answer.ok) throw new Error(`the program answers ${answer.status}`);
  return new LiveSurface(data, await answer.arrayBuffer());
}

export async function showLive(data, page) {
  document.title = `${data.name} – Supple`;
  const told = {};
  const connection = new Connection(takeToken(), data, told);
  let session;
  try {
    session = new Session(data, await readSurface(data, connection.address('/surface')), connection);
  } catch (error) {
    document.querySelector('body > .body-view')?.remove();
    page.replaceChildren(element('header', {}, element('h1', {}, data.name)), element('div', {class: 'notice bad', role: 'alert'}, `The body can't be shown: ${error.message}.`));
    return;
  }
  Object.assign(told, {changed: (...status) => session.changed(...status), frame: () => session.frame(), state: (message) => session.onState(message), rows: (message) => session.onRows(message),
    failed: (message) => session.onFailed(message), ended: (message) => session.onEnded(message), again: (message) => session.again.take(message),
    refused: (message) => message.answered || session.tell(message.message)});
  page.replaceChildren(...session.root());
  connection.open();
  window.supple = makeHooks(session);
}
